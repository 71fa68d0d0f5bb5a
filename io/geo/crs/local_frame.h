// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "terrain/model/georeference.h"

namespace arete {

/// The parameters of a local frame, which define it completely.
struct LocalFrameSpec {
  Vec3 origin = {};  ///< in source coordinates
  bool isGeographic = false;
  double linearUnitMetres = 1;              ///< of a projected CRS, or without one
  std::array<double, 2> mapScale = {1, 1};  ///< along x and y of a projected CRS: Georeference::mapScale
  double verticalUnitMetres = 1;
  double angularUnitRadians = 0.017453292519943295;  ///< of a geographic CRS, as are the next three
  double semiMajorAxisMetres = 6378137;
  double inverseFlattening = 298.257223563;  ///< 0 = sphere
  /// toSource() returns longitudes within half a turn of this one, so that grids of 0..360 degrees and grids
  /// across the antimeridian stay connected.
  double middleLongitude = 0;

  bool operator==(const LocalFrameSpec&) const = default;
};

/// A right-handed frame of metres about an origin: x east, y north, z up.
///
/// With a projected CRS (or none): the map's own axes, scaled to metres on the
/// ground by its unit and its scale; the height axis is straight, as on
/// the map. With a geographic CRS: a Cartesian frame tangent to the ellipsoid at the origin (GeographicLib's
/// LocalCartesian), in which the Earth is curved. Heights are used as heights above the ellipsoid whatever
/// their datum, since no geoid is assumed.
///
/// Accuracy of toSource(toLocal()): projected, a few ulp; geographic, 10 nm within 5000 km of the surface
/// (not for heights below the centre and longitudes at the poles). Thread-safe; cheap to copy.
class LocalFrame {
 public:
  /// Errors: invalidData: a unit, an axis or the origin is out of range (zero, negative, not finite, a
  /// latitude beyond the pole).
  static Result<LocalFrame> create(const LocalFrameSpec& spec);

  const LocalFrameSpec& spec() const { return spec_; }

  /// From source coordinates to metres in the frame. Not finite for a latitude beyond the pole.
  Vec3 toLocal(const Vec3& source) const;
  Vec3 toSource(const Vec3& local) const;

  /// Bounds the effect of rounding local coordinates on source coordinates, in each axis.
  /// @param metres  the largest change of each local coordinate
  /// @param low, high  a box around the source coordinates of the positions
  /// @return the largest change of each source coordinate
  Vec3 sourceReach(const Vec3& metres, const Vec3& low, const Vec3& high) const;

 private:
  struct Cartesian;
  explicit LocalFrame(const LocalFrameSpec& spec);

  LocalFrameSpec spec_;
  Vec2 unit_ = {1, 1};  // metres on the ground along x and y of a map
  double degreesPerUnit_ = 1;
  std::shared_ptr<const Cartesian> cartesian_;  // of a geographic CRS
};

/// The parameters of the frame of a CRS. Without a CRS, units are taken as metres.
/// @param origin  in source coordinates
LocalFrameSpec localFrameSpec(const Georeference& georeference, const Vec3& origin);

}  // namespace arete
