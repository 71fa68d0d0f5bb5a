// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/vec.h"

namespace arete {

/// Points as read, before equal ones are merged.
struct PointRows {
  std::vector<Vec2> positions;
  std::vector<double> heights;
  std::vector<std::uint64_t> origins;  ///< line number or feature id, for messages
  int srid = 0;                        ///< the number of EPSG that a text states for all of them; 0: none
  std::uint64_t withoutPlace = 0;      ///< rows without x or y; what is missing is NaN

  std::string xName = "x", yName = "y";  ///< of the columns, where a line names them

  void add(double x, double y, double z, std::uint64_t origin) {
    // -0 becomes 0, so that equal positions have equal bytes.
    positions.push_back({x + 0.0, y + 0.0});
    heights.push_back(z + 0.0);
    origins.push_back(origin);
  }
};

}  // namespace arete
