// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/finest_raster.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace arete {
namespace {

/// Bits 0, 2, 4, ... of x, moved together.
std::uint32_t everyOtherBit(std::uint64_t x) {
  std::uint32_t bits = 0;
  for (int i = 0; i < 32; ++i) bits |= static_cast<std::uint32_t>(x >> (2 * i) & 1) << i;
  return bits;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> finestTriangulation(const RasterHeightfield& heightfield) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  if (heightfield.columns < 2 || heightfield.rows < 2) return triangles;
  triangles.reserve(std::size_t(heightfield.columns - 1) * (heightfield.rows - 1) * 2);
  const auto addCell = [&](std::uint32_t column, std::uint32_t row) {
    const std::uint32_t upperLeft = heightfield.index(column, row), upperRight = upperLeft + 1,
                        lowerLeft = upperLeft + heightfield.columns, lowerRight = lowerLeft + 1;
    const bool ul = !std::isnan(heightfield.heights[upperLeft]),
               ur = !std::isnan(heightfield.heights[upperRight]),
               ll = !std::isnan(heightfield.heights[lowerLeft]),
               lr = !std::isnan(heightfield.heights[lowerRight]);
    if (ul && lr) {
      if (ur) triangles.push_back({upperLeft, upperRight, lowerRight});
      if (ll) triangles.push_back({upperLeft, lowerRight, lowerLeft});
    } else if (ur && ll) {
      if (ul) triangles.push_back({upperLeft, upperRight, lowerLeft});
      if (lr) triangles.push_back({upperRight, lowerRight, lowerLeft});
    }
  };
  // Tile by tile, so that triangles near each other on the ground are near each other in memory, at every
  // scale: in Morton's order within squares, the squares side by side.
  constexpr std::uint32_t kTile = 32;
  const std::uint32_t across = (heightfield.columns + kTile - 2) / kTile,
                      down = (heightfield.rows + kTile - 2) / kTile;
  const std::uint32_t side = std::bit_ceil(std::min(across, down));
  const auto addTile = [&](std::uint32_t left, std::uint32_t top) {
    for (std::uint32_t row = top; row < std::min(top + kTile, heightfield.rows - 1); ++row)
      for (std::uint32_t column = left; column < std::min(left + kTile, heightfield.columns - 1); ++column)
        addCell(column, row);
  };
  for (std::uint32_t y = 0; y < down; y += side)
    for (std::uint32_t x = 0; x < across; x += side)
      for (std::uint64_t code = 0; code < std::uint64_t(side) * side; ++code)
        addTile((x + everyOtherBit(code)) * kTile, (y + everyOtherBit(code >> 1)) * kTile);
  return triangles;
}

}  // namespace arete
