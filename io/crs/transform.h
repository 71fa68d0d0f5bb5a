// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "io/crs/longitude_turns.h"
#include "terrain/model/georeference.h"

namespace arete {

/// Brings plan positions from one CRS into another; x is easting or longitude in both, whatever order the CRS
/// states its axes in. Heights are none of its business. One thread at a time.
class CrsTransform {
 public:
  /// Leaves every position where it is.
  CrsTransform();
  CrsTransform(CrsTransform&&) noexcept;
  CrsTransform& operator=(CrsTransform&&) noexcept;
  ~CrsTransform();

  /// from, to: WKT or any text GDAL takes. Errors: usage (not a CRS), invalidData (there is no way from one
  /// to the other, for instance from one celestial body to another).
  static Result<CrsTransform> between(const std::string& from, const std::string& to);

  /// From longitude and latitude in degrees: of WGS 84 where the target lies on the Earth, of the target's
  /// own datum elsewhere. Errors: usage where the target has no CRS, and those of between().
  static Result<CrsTransform> fromLonLat(const Georeference& target);

  /// Positions are brought to where a DEM is by whole turns of their longitude, behind all else.
  void setTurns(const LongitudeTurns& turns) { turns_ = turns; }

  bool isIdentity() const { return !state_; }
  /// What fromLonLat() and between() start from, as WKT 2; empty for the identity.
  const std::string& sourceWkt() const { return sourceWkt_; }

  /// Nothing where the target cannot tell the position.
  std::optional<Vec2> operator()(Vec2 p) const;
  /// All of them in place; NaN where the target cannot tell one. O(positions).
  void apply(std::span<Vec2> positions) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
  std::string sourceWkt_;
  LongitudeTurns turns_;
};

}  // namespace arete
