// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/repair/places.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace arete::repair_passes {

std::vector<std::uint32_t> placesOf(std::span<const Vec3> positions) {
  std::vector<std::uint32_t> order(positions.size()), place(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t v) {
    return std::tuple(positions[v].x + 0, positions[v].y + 0, positions[v].z + 0);  // -0 and 0 are one
  };
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    const auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  for (std::size_t i = 0, begin = 0; i < order.size(); ++i) {
    if (key(order[i]) != key(order[begin])) begin = i;
    place[order[i]] = order[begin];
  }
  return place;
}

}  // namespace arete::repair_passes
