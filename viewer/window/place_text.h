// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "io/crs/lonlat.h"
#include "terrain/locate/surface_height.h"

namespace arete {

/// Coordinates as a person reads and types them.
class PlaceText {
 public:
  /// Precondition: the heights outlive this.
  explicit PlaceText(const SurfaceHeights& heights);

  /// Source coordinates: decimetres of a projected CRS, a millionth of a degree.
  std::string xy(Vec2 xy) const;
  /// "8.550000° E, 46.600000° N"; empty where the CRS knows none.
  std::string lonLat(Vec2 xy) const;
  std::string height(double height) const;
  bool hasLonLat() const { return lonLat_.has_value(); }
  /// Source coordinates are longitude and latitude in degrees themselves: once is enough.
  bool isLonLat() const;

  struct Goal {
    Vec2 xy;
    double ground = 0;  ///< height of the terrain there; the middle of the DEM's where there is none
    std::optional<double> height;  ///< as the DEM's heights; nothing: a place on the ground was asked for
  };
  /// "X,Y" or "X,Y,H", H as io/crs/position_argument.h has it; a longitude may be whole turns off. Errors:
  /// usage, invalidData, naming what was typed;
  /// a place outside of the terrain has none without a height.
  Result<Goal> read(const std::string& text, bool isLonLat) const;

 private:
  const SurfaceHeights& heights_;
  std::optional<CrsLonLat> lonLat_;
};

}  // namespace arete
