// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "io/geo/crs/lonlat.h"
#include "terrain/locate/ground_height.h"

namespace arete {

/// Formats and parses coordinates for the user.
class PlaceText {
 public:
  /// Precondition: the heights outlive this.
  explicit PlaceText(const GroundHeights& heights);

  /// Source coordinates: decimetres of a projected CRS, a millionth of a degree.
  std::string xy(Vec2 xy) const;
  /// "8.550000° E, 46.600000° N"; empty if the CRS has no longitude and latitude.
  std::string lonLat(Vec2 xy) const;
  std::string height(double height) const;
  bool hasLonLat() const { return lonLat_.has_value(); }
  /// Whether source coordinates are longitude and latitude in degrees already, so that one text is enough.
  bool isLonLat() const;

  struct Goal {
    Vec2 xy;
    double ground = 0;             ///< height of the terrain there; without terrain there: the stated height
    std::optional<double> height;  ///< in the DEM's heights; empty: a place on the ground
  };
  /// "X,Y" or "X,Y,H", H as io/geo/crs/position_argument.h has it; a longitude may be whole turns off.
  /// Errors: usage, invalidData, naming the text; invalidData: a place outside the terrain without a height.
  Result<Goal> read(const std::string& text, bool isLonLat) const;

 private:
  const GroundHeights& heights_;
  std::optional<CrsLonLat> lonLat_;
};

}  // namespace arete
