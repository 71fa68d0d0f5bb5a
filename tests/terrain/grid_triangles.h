// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace arete::testing {

/// The finest triangulation of a small raster, written plainly so that tests depend on nothing they test.
/// Counter-clockwise with the row axis pointing down, that is, seen from +z on a north-up raster.
inline std::vector<std::array<std::uint32_t, 3>> gridTriangles(std::uint32_t columns, std::uint32_t rows,
                                                               std::span<const double> heights) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t r = 0; r + 1 < rows; ++r) {
    for (std::uint32_t c = 0; c + 1 < columns; ++c) {
      const std::uint32_t ul = r * columns + c, ur = ul + 1, ll = ul + columns, lr = ll + 1;
      const auto hole = [&](std::uint32_t v) { return std::isnan(heights[v]); };
      const int holes = int(hole(ul)) + int(hole(ur)) + int(hole(ll)) + int(hole(lr));
      if (holes > 1) continue;
      if (hole(ul)) triangles.push_back({ur, ll, lr});
      if (hole(lr)) triangles.push_back({ul, ll, ur});
      if (holes == 0 || hole(ur)) triangles.push_back({ul, ll, lr});
      if (holes == 0 || hole(ll)) triangles.push_back({ul, lr, ur});
    }
  }
  return triangles;
}

inline std::vector<double> gridHeights(std::uint32_t columns, std::uint32_t rows,
                                       const std::function<double(double column, double row)>& height) {
  std::vector<double> heights;
  for (std::uint32_t r = 0; r < rows; ++r) {
    for (std::uint32_t c = 0; c < columns; ++c) heights.push_back(height(c, r));
  }
  return heights;
}

}  // namespace arete::testing
