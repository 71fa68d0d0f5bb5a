// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

#include "engine/base/vec.h"

namespace arete {

/// A point as a field of a table has it.
struct WktPoint {
  std::optional<Vec2> place;  ///< nothing: empty
  std::optional<double> z;
  int srid = 0;  ///< the number of EPSG that EWKT states; 0: none
};

/// Reads a point in Well-known Text: "POINT (15 47)", "POINT Z (15 47 300)", "POINTZ(15 47 300)", "POINT (15
/// 47 300)", "POINT M (15 47 1)", "POINT ZM (...)", "POINT EMPTY", also as the only point of a MULTIPOINT, in
/// either case, and after "SRID=4326;" as PostGIS writes it (EWKT).
///
/// @return Nothing for other geometries and other texts, and for a coordinate that is not finite. O(length).
std::optional<WktPoint> readWktPoint(std::string_view text);

}  // namespace arete
