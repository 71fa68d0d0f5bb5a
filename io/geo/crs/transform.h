// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "io/geo/crs/longitude_turns.h"
#include "terrain/model/georeference.h"

namespace arete {

/// Transforms plan positions from one CRS to another. x is easting or longitude in both, whatever the order
/// of the axes of the CRS. Heights are not transformed. Not thread-safe.
class CrsTransform {
 public:
  /// The identity.
  CrsTransform();
  CrsTransform(CrsTransform&&) noexcept;
  CrsTransform& operator=(CrsTransform&&) noexcept;
  ~CrsTransform();

  enum class Ballpark { allowed, refused };
  /// @param from,to WKT or any text that crsFromText() accepts.
  ///
  /// @param ballpark  refused: where PROJ knows no transformation between the datums, or lacks the grid of
  /// the only one, there is none, instead of one that takes the datums for the same.
  ///
  /// Errors: invalidData: not a CRS, or there is no transformation, for instance between celestial bodies.
  static Result<CrsTransform> between(const std::string& from, const std::string& to,
                                      Ballpark ballpark = Ballpark::allowed);

  /// From longitude and latitude in degrees: of WGS 84 if the target is on the Earth, of the target's own
  /// datum otherwise. Errors: usage: the target has no CRS. Also those of between().
  static Result<CrsTransform> fromLonLat(const Georeference& target);

  /// Applied after the transformation: shifts longitudes by whole turns onto a DEM.
  void setTurns(const LongitudeTurns& turns) { turns_ = turns; }

  bool isIdentity() const { return !state_; }
  /// The source CRS of fromLonLat() or between(), as WKT 2; empty for the identity.
  const std::string& sourceWkt() const { return sourceWkt_; }

  /// @return Nothing if the position is outside the domain of the target.
  std::optional<Vec2> operator()(Vec2 p) const;
  /// In place. A position outside the domain of the target becomes NaN. O(positions).
  void apply(std::span<Vec2> positions) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
  std::string sourceWkt_;
  LongitudeTurns turns_;
};

}  // namespace arete
