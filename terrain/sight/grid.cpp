// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/sight/grid.h"

#include <algorithm>
#include <utility>

namespace arete {

SightGrid::SightGrid(const TerrainModel& model)
    : SightGrid(model.columns, model.rows, model.rasterSamples().heights) {}

SightGrid::SightGrid(std::uint32_t columns, std::uint32_t rows, std::vector<double> heights)
    : columns_(columns), rows_(rows), heights_(std::move(heights)) {}

double SightGrid::at(Vec2 p) const {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (!(p.x >= 0 && p.y >= 0 && p.x <= columns_ - 1 && p.y <= rows_ - 1)) return kNone;
  const auto column = static_cast<std::uint32_t>(p.x), row = static_cast<std::uint32_t>(p.y);
  // A place on a lattice line is in two cells, a sample in four. The first of them that has terrain there is
  // used.
  const std::uint32_t columnsBefore = p.x == column && column > 0 ? 1 : 0,
                      rowsBefore = p.y == row && row > 0 ? 1 : 0;
  for (std::uint32_t up = 0; up <= rowsBefore; ++up)
    for (std::uint32_t left = 0; left <= columnsBefore; ++left) {
      const std::uint32_t c = column - left, r = row - up;
      if (c + 1 >= columns_ || r + 1 >= rows_) continue;
      const SightCell cell{height(c, r), height(c + 1, r), height(c, r + 1), height(c + 1, r + 1)};
      const int corners = cell.corners();
      const double x = p.x - c, y = p.y - r;
      if (corners < 3 || (corners == 3 && !(cell.inside(x, y) >= 0))) continue;
      return cell.at(x, y);
    }
  return kNone;
}

}  // namespace arete
