// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "terrain/model/georeference.h"

namespace arete {

/// What a local frame is made of; with it, anybody can make it again.
struct LocalFrameSpec {
  Vec3 origin = {};  ///< in source coordinates
  bool isGeographic = false;
  double linearUnitMetres = 1;  ///< of a projected CRS, or without one
  double verticalUnitMetres = 1;
  double angularUnitRadians = 0.017453292519943295;  ///< of a geographic CRS, as are the next three
  double semiMajorAxisMetres = 6378137;
  double inverseFlattening = 298.257223563;  ///< 0 = sphere
  /// Longitudes come back within half a turn of this one, so that grids of 0..360 degrees and grids across
  /// the antimeridian stay whole.
  double middleLongitude = 0;

  bool operator==(const LocalFrameSpec&) const = default;
};

/// A right-handed frame of metres about an origin: x east, y north, z up.
///
/// Of a projected CRS (or none) the map's own axes, scaled to metres: the height axis is straight, as on the
/// map. Of a geographic CRS a Cartesian frame that touches the ellipsoid at the origin (GeographicLib's
/// LocalCartesian), in which the Earth curves away; heights are taken as heights above the ellipsoid whatever
/// their datum, since no geoid is assumed.
///
/// Accuracy: projected, a few ulp; geographic, 10 nm within 5000 km of the surface there and back (heights
/// below the centre and longitudes at the poles do not come back). Thread safe; cheap to copy.
class LocalFrame {
 public:
  /// Errors: invalidData for units, axes or an origin that make no sense (zero, negative, not finite, a
  /// latitude beyond the pole).
  static Result<LocalFrame> create(const LocalFrameSpec& spec);

  const LocalFrameSpec& spec() const { return spec_; }

  /// Not finite for a latitude beyond the pole.
  Vec3 toLocal(const Vec3& source) const;
  Vec3 toSource(const Vec3& local) const;

  /// How far source coordinates may move, axis by axis, when each local coordinate moves by `metres` at most
  /// (axis by axis), for positions whose source coordinates lie in the box `low`..`high`.
  Vec3 sourceReach(const Vec3& metres, const Vec3& low, const Vec3& high) const;

 private:
  struct Cartesian;
  explicit LocalFrame(const LocalFrameSpec& spec);

  LocalFrameSpec spec_;
  double degreesPerUnit_ = 1;
  std::shared_ptr<const Cartesian> cartesian_;  // of a geographic CRS
};

/// The frame of a CRS about `origin`. Without a CRS units count as metres.
LocalFrameSpec localFrameSpec(const Georeference& georeference, const Vec3& origin);

}  // namespace arete
