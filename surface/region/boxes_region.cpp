// SPDX-License-Identifier: GPL-3.0-or-later
//
// A binary tree of boxes around boxes, halved at the median of the middles along the longest side. Nodes
// follow each other in the order of a walk, the first half of each behind it.
#include "surface/region/boxes_region.h"

#include <algorithm>
#include <utility>

namespace arete {
namespace {

double middleAlong(const std::array<Vec3, 2>& box, std::size_t axis) {
  const auto along = [axis](const Vec3& p) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; };
  return along(box[0]) / 2 + along(box[1]) / 2;
}

}  // namespace

BoxesRegion::BoxesRegion(std::vector<std::array<Vec3, 2>> boxes) : boxes_(std::move(boxes)) {
  nodes_.reserve(2 * boxes_.size());
  if (!boxes_.empty()) split(0, boxes_.size());
}

void BoxesRegion::split(std::size_t first, std::size_t count) {
  std::array<Vec3, 2> around = boxes_[first];
  for (std::size_t i = first; i < first + count; ++i) {
    const auto& [low, high] = boxes_[i];
    around[0] = {std::min(around[0].x, low.x), std::min(around[0].y, low.y), std::min(around[0].z, low.z)};
    around[1] = {std::max(around[1].x, high.x), std::max(around[1].y, high.y), std::max(around[1].z, high.z)};
  }
  const std::size_t at = nodes_.size();
  nodes_.push_back({BoxRegion(around[0], around[1]), count, 0});
  if (count == 1) return;
  const Vec3 size = around[1] - around[0];
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto begin = boxes_.begin() + static_cast<std::ptrdiff_t>(first);
  const std::size_t half = count / 2;
  std::nth_element(
      begin, begin + static_cast<std::ptrdiff_t>(half), begin + static_cast<std::ptrdiff_t>(count),
      [axis](const auto& a, const auto& b) { return middleAlong(a, axis) < middleAlong(b, axis); });
  split(first, half);
  nodes_[at].second = nodes_.size();
  split(first + half, count - half);
}

template <class MayHold, class Test>
bool BoxesRegion::holdsOfAny(const MayHold& mayHold, const Test& test) const {
  std::vector<std::size_t> left;
  if (!nodes_.empty()) left.push_back(0);
  while (!left.empty()) {
    const std::size_t at = left.back();
    left.pop_back();
    const Node& node = nodes_[at];
    if (node.count == 1) {
      if (test(node.box)) return true;
    } else if (mayHold(node.box)) {
      left.push_back(node.second);
      left.push_back(at + 1);
    }
  }
  return false;
}

bool BoxesRegion::meetsTriangle(const SpaceTriangle& triangle, double widening) const {
  const auto meets = [&](const BoxRegion& box) { return box.meetsTriangle(triangle, widening); };
  return holdsOfAny(meets, meets);
}

bool BoxesRegion::meetsBall(const Vec3& c, double r) const {
  const auto meets = [&](const BoxRegion& box) { return box.meetsBall(c, r); };
  return holdsOfAny(meets, meets);
}

bool BoxesRegion::holdsBall(const Vec3& c, double r) const {
  const auto holds = [&](const BoxRegion& box) { return box.holdsBall(c, r); };
  return holdsOfAny(holds, holds);
}

}  // namespace arete
