// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "terrain/sight/earth.h"
#include "terrain/sight/profile.h"
#include "viewer/camera/camera_space.h"
#include "viewer/camera/home_view.h"
#include "viewer/scene/curved_ground.h"

namespace arete {

/// A place of the terrain that was picked with the mouse.
struct TerrainPick {
  Vec2 plan;          ///< plan coordinates of the model
  Vec2 xy;            ///< source coordinates
  double height = 0;  ///< GroundHeights::at(xy), in the DEM's vertical unit
  Vec3 metric;        ///< heights as they are, not exaggerated
  double metres = 0;  ///< from the eye, in a straight line
};

/// Finds the place of the terrain at a pixel: the first intersection of its ray with the surface at full
/// resolution, whichever front is drawn. Keeps references; thread-safe.
class TerrainPicker {
 public:
  /// Precondition: model and profiles outlive this. O(vertices).
  TerrainPicker(const TerrainModel& model, const Profiles& profiles);

  /// From a point in a direction of any length but 0, in metric space. From above or from below the surface.
  /// O(triangles below the ray * depth).
  std::optional<TerrainPick> along(const Vec3& eye, const Vec3& direction) const;
  /// The place that a camera shows at a pixel, from the top left of its picture, heights drawn `stretch`
  /// times as high.
  std::optional<TerrainPick> at(const Camera& camera, Vec2 pixel, double stretch = 1) const;

  /// The same on a curved Earth, where the ray bends over the map: in chords
  /// that are off by some centimetres at most.
  std::optional<TerrainPick> at(const CurvedGround& ground, const Camera& camera, Vec2 pixel,
                                double stretch = 1) const;

  /// The pixel of a metric point on a curved Earth; nothing where it is not in front of the camera.
  std::optional<Vec2> pixelOf(const CurvedGround& ground, const Camera& camera, const Vec3& metric,
                              double stretch = 1) const;

  const CameraSpace& space() const { return space_; }
  const MetricBox& box() const { return box_; }

 private:
  /// The first intersection between two points.
  std::optional<TerrainPick> between(const Vec3& first, const Vec3& last, const Vec3& eye) const;
  /// @param inside a place of the triangle that was hit, in the plan.
  std::optional<TerrainPick> pickOf(const Vec3& hit, const Vec3& inside, const Vec3& eye) const;

  const TerrainModel& model_;
  const Profiles& profiles_;
  CameraSpace space_;
  MetricBox box_;
  std::unique_ptr<SightEarth> plane_;
};

/// The direction, in the space that is drawn, of a pixel of a camera's picture.
Vec3 directionOfPixel(const CameraSpace& space, const Camera& camera, Vec2 pixel);

/// The pixel of a metric point in a camera's picture; nothing where it is not in front of it.
std::optional<Vec2> pixelOf(const CameraSpace& space, const Camera& camera, const Vec3& metric,
                            double stretch = 1);

}  // namespace arete
