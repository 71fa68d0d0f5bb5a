// SPDX-License-Identifier: GPL-3.0-or-later
//
// The box of the terrain bends with the ground, so its corners alone do not bound it. A grid over its bottom
// and its top does: it is dense enough that the ground between neighbours rises by far less than the free
// margin of the picture, even for a whole planet.
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
                        const MetricBox& box, const Camera& picture, double stretch) {
  std::vector<Vec3> points;
  for (int j = 0; j <= kCells; ++j)
    for (int i = 0; i <= kCells; ++i)
      for (const double z : {box.low.z, box.high.z}) {
        const Vec3 flat{box.low.x + (box.high.x - box.low.x) * i / kCells,
                        box.low.y + (box.high.y - box.low.y) * j / kCells, z};
        const Vec3 p = ground.position(space.xy(flat), space.height(flat), stretch);
        if (std::isfinite(p.x + p.y + p.z)) points.push_back(p);
      }
  for (double tilt = 0; tilt <= kMostTilt && !points.empty(); ++tilt) {
    Look look = homeLook(view);
    look.pitchDegrees = std::max(look.pitchDegrees - tilt, -90.0);
    const PictureAxes axes = axesOf(space, look);
    const auto camera = ground.cameraAt(eyeOnAll(points, axes, picture), axes, picture, stretch);
    if (camera) return *camera;
  }
  return homeCamera(view, space, box, picture, stretch);
}

}  // namespace arete
