// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/vec.h"
#include "terrain/model/camera.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// The direction of a camera.
struct Look {
  double azimuthDegrees = 0;  ///< clockwise from north, 0 to below 360
  double pitchDegrees = 0;    ///< above the horizon
};

/// The metric space of a model (terrain/model/camera.h), in which cameras move, and the conversions: metres
/// (source units without a CRS), z up. Directions agree with viewOf(). The space may be mirrored against the
/// map; right() is on the right of the map all the same. A small value that does not refer to the model.
class CameraSpace {
 public:
  explicit CameraSpace(const TerrainModel& model);
  /// Of a space that is metric as it is: x to the east, y to the north, heights along z. As of surfaces.
  CameraSpace() = default;

  /// metricPosition() of the camera.
  Vec3 position(const Camera& camera) const { return position(camera.xy, camera.height); }
  Vec3 position(Vec2 xy, double height) const;
  /// Source coordinates, and height in the DEM's vertical unit, of a metric position.
  Vec2 xy(const Vec3& position) const;
  double height(const Vec3& position) const { return position.z / metresPerHeight_ + originHeight_; }
  /// The camera moved to a metric position.
  Camera at(Camera camera, const Vec3& position) const;

  /// Where the camera looks, what is up in its picture, and what is on its right: unit vectors, the last one
  /// level. In terms of curves tangent, normal and binormal.
  Vec3 forward(Look look) const;
  Vec3 up(Look look) const;
  Vec3 right(double azimuthDegrees) const;
  /// Of a direction of any length but 0. A vertical direction has no azimuth and gets `azimuthThere`.
  Look lookAlong(const Vec3& direction, double azimuthThere = 0) const;

  /// Metres of one unit of height.
  double metresPerHeight() const { return metresPerHeight_; }
  /// Whether the space turns the other way round than the map.
  bool isMirrored() const { return isMirrored_; }

 private:
  Vec3 level(double azimuthDegrees) const;

  Vec2 originXy_;  // in the source
  double originHeight_ = 0, metresPerHeight_ = 1;
  Vec2 perX_{1, 0}, perY_{0, 1};   // metric steps of one unit of x, of y
  Vec2 east_{1, 0}, north_{0, 1};  // unit vectors
  bool isMirrored_ = false;
};

/// What a camera sees, in the space that it moves in. Errors: usage, culprit "camera".
Result<View> viewOf(const Camera& camera, const CameraSpace& space);

/// An azimuth in 0 to below 360.
double wrappedAzimuth(double degrees);

/// The direction of a camera.
inline Look lookOf(const Camera& camera) {
  return {camera.azimuthDegrees, camera.pitchDegrees};
}

}  // namespace arete
