// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "viewer/camera/camera_space.h"

namespace arete {

/// A box in metric space that holds a terrain.
struct MetricBox {
  Vec3 low, high;

  Vec3 centre() const { return {(low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2}; }
  std::array<Vec3, 8> corners() const;
  double diagonal() const;
};

/// The bounding box of the triangulated terrain along the axes of the plan, without isolated samples.
/// O(vertices).
MetricBox metricBox(const TerrainModel& model);

/// What a home view has to have in its picture: the box of a model, and vertices of it that stand for all.
struct HomeShape {
  MetricBox box;
  std::vector<Vec3> points;  ///< at least one
};

/// The shape of vertices: all of them where they are few, else those that lie farthest in 26 directions in
/// each cell of a grid over their box. A vertex that is left out is beyond the hull of the points by less
/// than a hundredth of the box. O(vertices), in two passes.
///
/// @param at the position of a vertex. Vertices of positions that are not finite are left out.
/// Precondition: a vertex of a finite position.
HomeShape homeShape(std::uint32_t vertices, const std::function<Vec3(std::uint32_t)>& at);
/// Of the triangulated terrain in metric space: without NODATA and isolated samples, which are not drawn.
HomeShape homeShape(const TerrainModel& model);
/// The corners of a box.
HomeShape homeShape(const MetricBox& box);

/// What panels leave free of a picture: how much of its width and height they cover at each edge. Each pair
/// adds up to less than 1.
struct CoveredEdges {
  double left = 0, right = 0, top = 0, bottom = 0;

  bool operator==(const CoveredEdges&) const = default;
};

/// Views of the whole terrain.
enum class HomeView {
  overview,   ///< from the south, 30 degrees from above, or as many up to 60 as fill the picture
  fromAbove,  ///< straight down, north up
  fromSouth,  ///< this and the next three: from that side, level
  fromWest,
  fromNorth,
  fromEast,
};
inline constexpr std::array kHomeViews = {HomeView::overview, HomeView::fromAbove, HomeView::fromSouth,
                                          HomeView::fromWest, HomeView::fromNorth, HomeView::fromEast};
std::string_view toString(HomeView view);
/// Where it looks, in the middle of the terrain; an overview at the least.
Look homeLook(HomeView view);

/// Of a picture: unit vectors at right angles.
struct PictureAxes {
  Vec3 right, up, ahead;
};
PictureAxes axesOf(const CameraSpace& space, Look look);

/// The nearest eye that has all points in the free part of its picture, with a twentieth of that free on
/// either side at least, and as much on one as on the other, and not nearer to any of them than a fiftieth of
/// their extent. Only field of view and size are the camera's.
/// Preconditions: a point; a field of view of 0 to below 180 degrees. O(points).
Vec3 eyeOnAll(std::span<const Vec3> points, const PictureAxes& axes, const Camera& picture,
              const CoveredEdges& covered = {});

/// A look that is steeper, 60 degrees down at most, until the points fill the height of the picture as they
/// fill its width. O(points).
///
/// @param axesOfLook the axes of a look there.
Look filling(Look look, std::span<const Vec3> points, const std::function<PictureAxes(Look)>& axesOfLook,
             const Camera& picture, const CoveredEdges& covered = {});

/// The nearest camera of a direction that has all of the shape in its picture, as eyeOnAll() has it.
/// `picture` gives field of view and size; where it is of a parallel projection, so is the camera, in the
/// least height that has all of the shape in its free part. Precondition: a field of view of 0 to below 180
/// degrees.
Camera cameraOnAll(const CameraSpace& space, const HomeShape& shape, Look look, const Camera& picture = {},
                   const CoveredEdges& covered = {});

/// A home view of a shape in the space of its model. `stretch`: heights are drawn so many times as high, > 0.
Camera homeCamera(HomeView view, const CameraSpace& space, const HomeShape& shape, const Camera& picture = {},
                  double stretch = 1, const CoveredEdges& covered = {});
/// The same of a box, as if the terrain filled it.
Camera homeCamera(HomeView view, const CameraSpace& space, const MetricBox& box, const Camera& picture = {},
                  double stretch = 1);

}  // namespace arete
