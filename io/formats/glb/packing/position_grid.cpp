// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/glb/packing/position_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace arete {

PositionGrid PositionGrid::of(std::span<const Float3> positions, int bits) {
  PositionGrid grid;
  if (positions.empty()) return grid;
  Float3 low = positions.front(), high = low;
  for (const Float3& p : positions)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  grid.low = low;
  double side = 0;
  for (std::size_t k = 0; k < 3; ++k) side = std::max(side, double{high[k]} - double{low[k]});
  if (side == 0) return grid;
  // A float, so that readers which take the scale as one have the same grid; not below the step, so that the
  // highest position is within the bits.
  const double step = side / ((1 << bits) - 1);
  grid.step = std::max(static_cast<float>(step), std::numeric_limits<float>::min());
  if (double{grid.step} < step) grid.step = std::nextafter(grid.step, std::numeric_limits<float>::max());
  return grid;
}

PositionGrid::Point PositionGrid::nearest(const Float3& position) const {
  Point point{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double steps = std::round((double{position[k]} - double{low[k]}) / double{step});
    point[k] = static_cast<std::uint16_t>(std::clamp(steps, 0.0, 65535.0));
  }
  return point;
}

std::uint64_t countFallenTogether(std::span<const Float3> positions,
                                  std::span<const PositionGrid::Point> on) {
  std::vector<Float3> before(positions.begin(), positions.end());
  std::vector<PositionGrid::Point> after(on.begin(), on.end());
  const auto distinct = [](auto& places) {
    std::ranges::sort(places);
    return static_cast<std::uint64_t>(std::unique(places.begin(), places.end()) - places.begin());
  };
  return distinct(before) - distinct(after);
}

double errorOfGrid(const TriangleMesh& mesh, std::span<const Float3> positions, double step) {
  bool isHeightField = true;
  double steepest = 0;
  for (const auto& t : mesh.triangles) {
    const auto from = [&](std::size_t corner, std::size_t k) {
      return double{positions[t[corner]][k]} - double{positions[t[0]][k]};
    };
    // y is up; z points to the south, so that a triangle that is seen from above has a positive area here.
    const double ux = from(1, 0), uy = from(1, 1), uz = from(1, 2);
    const double vx = from(2, 0), vy = from(2, 1), vz = from(2, 2);
    const double area = uz * vx - ux * vz;
    if (area == 0) continue;
    isHeightField = isHeightField && area > 0;
    steepest = std::max(steepest, std::hypot((uy * vz - vy * uz) / area, (uy * vx - vy * ux) / area));
  }
  constexpr double kSpaceDiagonal = 1.7320508075688774, kPlanDiagonal = 1.4142135623730951;
  return step / 2 * (isHeightField ? 1 + kPlanDiagonal * steepest : kSpaceDiagonal);
}

}  // namespace arete
