// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of a shape lie on the ground wherever that bends. A box says less: a grid over its bottom and
// its top is dense enough that the ground between neighbours rises by far less than the free margin of the
// picture, even for a whole planet.
#include "viewer/scene/curved_home_view.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace arete {
namespace {

constexpr int kCells = 32;
constexpr double kMostTilt = 5;  // degrees

}  // namespace

Camera curvedHomeCamera(HomeView view, const CurvedGround& ground, const CameraSpace& space,
                        const HomeShape& shape, const Camera& picture, double stretch,
                        const CoveredEdges& covered) {
  std::vector<Vec3> points;
  for (const Vec3& flat : shape.points) {
    const Vec3 p = ground.position(space.xy(flat), space.height(flat), stretch);
    if (std::isfinite(p.x + p.y + p.z)) points.push_back(p);
  }
  Look home = homeLook(view);
  if (view == HomeView::overview && !points.empty())
    home = filling(
        home, points, [&](Look look) { return axesOf(space, look); }, picture, covered);
  for (double tilt = 0; tilt <= kMostTilt && !points.empty(); ++tilt) {
    Look look = home;
    look.pitchDegrees = std::max(look.pitchDegrees - tilt, -90.0);
    const PictureAxes axes = axesOf(space, look);
    const auto camera = ground.cameraAt(eyeOnAll(points, axes, picture, covered), axes, picture, stretch);
    if (camera) return *camera;
  }
  return homeCamera(view, space, shape, picture, stretch, covered);
}

Camera curvedHomeCamera(HomeView view, const CurvedGround& ground, const CameraSpace& space,
                        const MetricBox& box, const Camera& picture, double stretch) {
  HomeShape shape{.box = box, .points = {}};
  for (int j = 0; j <= kCells; ++j)
    for (int i = 0; i <= kCells; ++i)
      for (const double z : {box.low.z, box.high.z})
        shape.points.push_back({box.low.x + (box.high.x - box.low.x) * i / kCells,
                                box.low.y + (box.high.y - box.low.y) * j / kCells, z});
  return curvedHomeCamera(view, ground, space, shape, picture, stretch);
}

}  // namespace arete
