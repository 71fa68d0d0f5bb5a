// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "io/geo/bent/target.h"
#include "io/geo/crs/local_frame.h"
#include "io/geo/crs/transform.h"
#include "terrain/model/georeference.h"

namespace arete {

/// Leads positions from source coordinates into a target. Not thread-safe.
class PlaceMap {
 public:
  /// @param positions  of the mesh: "utm" takes its zone from them, and longitudes stay in one piece about
  ///                   their middle
  /// @param origin     in source coordinates: of the metric frame, and of formats of 32-bit floats
  /// Errors, with the field and its value as culprit: usage: no CRS, a target that is no CRS or states
  /// heights, as utmOf(). unsupported: a geocentric CRS. invalidData: PROJ knows no transformation but
  /// one that ignores the datums.
  static Result<PlaceMap> of(const Georeference& source, const PlaceTarget& target,
                             std::span<const Vec3> positions, const Vec3& origin);

  /// In place. A position that the target cannot have becomes NaN. O(positions).
  void apply(std::span<Vec3> positions) const;
  Vec3 operator()(Vec3 source) const;
  /// The unit vector, in the target, along which heights are measured at a place.
  Vec3 upAt(const Vec3& source) const;

  /// Straight edges stay straight: nothing bends.
  bool isLinear() const { return isLinear_; }
  /// The frame of a metric target.
  const std::optional<LocalFrame>& frame() const { return frame_; }
  /// WKT of the target; empty of a metric one.
  const std::string& crsWkt() const { return crsWkt_; }
  /// "WGS 84 / UTM zone 32N (EPSG:32632)", "metres".
  const std::string& name() const { return name_; }
  /// PlaceTarget as a culprit: "toCrs EPSG:32632", "metric".
  const std::string& culprit() const { return culprit_; }
  /// Upper bound on the rounding of a plan coordinate, in the unit of the target.
  double rounding() const { return rounding_; }
  /// Metres in one unit of x and y of the target, nearly.
  double unitMetres() const { return unitMetres_; }
  bool isGeographicSource() const { return isGeographicSource_; }

 private:
  PlaceMap() = default;
  void keepInOnePiece(const Georeference& source, const Georeference& target,
                      std::span<const Vec3> positions);

  std::optional<LocalFrame> frame_;
  CrsTransform transform_;
  std::string crsWkt_, name_, culprit_;
  bool isLinear_ = false, isGeographicSource_ = false;
  double rounding_ = 0, unitMetres_ = 1, verticalUnitMetres_ = 1;
  // x of the target is moved by whole turns next to xMiddle_ + (x of the source - sourceMiddle_) *
  // perSource_.
  double turn_ = 0, xMiddle_ = 0, sourceMiddle_ = 0, perSource_ = 0;
};

/// The georeference of the coordinates of a mesh file: its CRS and unit of heights. Errors: as
/// crsFromText() and describeCrs().
Result<Georeference> georeferenceOf(const std::string& crsWkt, const std::string& verticalUnit,
                                    double verticalUnitMetres = 0);

}  // namespace arete
