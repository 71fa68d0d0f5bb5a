// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/heights/contour_levels.h"

#include <algorithm>
#include <cmath>

namespace arete {

ContourLevels contourLevels(double interval, double base, double reach) {
  const double cycle = interval * ContourLevels::kCycle;
  ContourLevels levels{.interval = interval, .shift = (base - std::floor(base / cycle) * cycle) / interval};
  if (!(levels.shift >= 0 && levels.shift < ContourLevels::kCycle))
    levels.shift = 0;  // rounded up to a cycle
  // Four units in the last place of a float as large as the heights, and as the level that is made of them.
  constexpr double kBits = 0x1p-21;
  levels.lift = std::max(reach / interval, double(ContourLevels::kCycle)) * kBits;
  return levels;
}

}  // namespace arete
