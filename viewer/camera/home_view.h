// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <string_view>

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

/// Views of the whole terrain.
enum class HomeView {
  overview,   ///< from the south, 30 degrees from above
  fromAbove,  ///< straight down, north up
  fromSouth,  ///< this and the next three: from that side, level
  fromWest,
  fromNorth,
  fromEast,
};
inline constexpr std::array kHomeViews = {HomeView::overview, HomeView::fromAbove, HomeView::fromSouth,
                                          HomeView::fromWest, HomeView::fromNorth, HomeView::fromEast};
std::string_view toString(HomeView view);
/// Where it looks, in the middle of the terrain.
Look homeLook(HomeView view);

/// Of a picture: unit vectors at right angles.
struct PictureAxes {
  Vec3 right, up, ahead;
};
PictureAxes axesOf(const CameraSpace& space, Look look);

/// The nearest eye that has all points in its picture, with a twentieth of it free on either side at least.
/// Only field of view and size are the camera's. Preconditions: a point; a field of view of 0 to below 180
/// degrees. O(points).
Vec3 eyeOnAll(std::span<const Vec3> points, const PictureAxes& axes, const Camera& picture);

/// The nearest camera of a direction that has all of the box in its picture, with a twentieth of the picture
/// free on either side at least, and as much on one as on the other. `picture` gives field of view
/// and size. Precondition: a field of view of 0 to below 180 degrees.
Camera cameraOnAll(const CameraSpace& space, const MetricBox& box, Look look, const Camera& picture = {});

/// `stretch`: heights are drawn so many times as high, > 0.
Camera homeCamera(HomeView view, const CameraSpace& space, const MetricBox& box, const Camera& picture = {},
                  double stretch = 1);

}  // namespace arete
