// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/fronts/blended_order.h"

#include <algorithm>
#include <utility>

namespace arete {

// Ties are sorted by the order of adding, so a camera that returns sees the same picture.
void BlendedOrder::sort(Vec3 eye, Vec3 forward) {
  std::vector<std::pair<double, std::uint32_t>> keys(triangles_.size());
  for (std::uint32_t i = 0; i < keys.size(); ++i) keys[i] = {-dot(triangles_[i].middle - eye, forward), i};
  std::ranges::sort(keys);
  order_.resize(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) order_[i] = keys[i].second;
}

std::vector<std::array<std::uint32_t, 3>> BlendedOrder::corners() const {
  std::vector<std::array<std::uint32_t, 3>> corners;
  corners.reserve(order_.size());
  for (const std::uint32_t i : order_) corners.push_back(triangles_[i].corners);
  return corners;
}

std::vector<BlendedOrder::Run> BlendedOrder::runs() const {
  std::vector<Run> runs;
  for (std::uint32_t at = 0; at < order_.size(); ++at) {
    const std::uint32_t material = triangles_[order_[at]].material;
    if (runs.empty() || runs.back().material != material) runs.push_back({material, at, 0});
    ++runs.back().count;
  }
  return runs;
}

}  // namespace arete
