// SPDX-License-Identifier: GPL-3.0-or-later
//
// Segments are split at the median of their centres along the longer side of their box, in place, down to a
// few per leaf. The shape of the tree depends on the count alone, so it stores no child pointers.
#include "engine/base/segment_bvh.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace arete {

Box2 SegmentBvh::boxOf(const Segment2& s) {
  return {std::min(s.a.x, s.b.x), std::min(s.a.y, s.b.y), std::max(s.a.x, s.b.x), std::max(s.a.y, s.b.y)};
}

SegmentBvh::SegmentBvh(std::vector<Segment2> segments) : segments_(std::move(segments)) {
  if (segments_.empty()) return;
  std::size_t nodes = 1;
  for (std::size_t n = segments_.size(); n > kLeafSize; n = (n + 1) / 2) nodes = 2 * nodes + 1;
  boxes_.resize(nodes);
  build(0, 0, size());
}

void SegmentBvh::build(std::size_t node, std::uint32_t begin, std::uint32_t end) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box2 box{kInfinity, kInfinity, -kInfinity, -kInfinity};
  for (std::uint32_t i = begin; i < end; ++i) {
    const Box2 b = boxOf(segments_[i]);
    box = {std::min(box.xMin, b.xMin), std::min(box.yMin, b.yMin), std::max(box.xMax, b.xMax),
           std::max(box.yMax, b.yMax)};
  }
  boxes_[node] = box;
  if (end - begin <= kLeafSize) return;
  const bool alongX = box.xMax - box.xMin >= box.yMax - box.yMin;
  const std::uint32_t half = middle(begin, end);
  std::nth_element(segments_.begin() + begin, segments_.begin() + half, segments_.begin() + end,
                   [&](const Segment2& s, const Segment2& t) {
                     return alongX ? s.a.x + s.b.x < t.a.x + t.b.x : s.a.y + s.b.y < t.a.y + t.b.y;
                   });
  build(2 * node + 1, begin, half);
  build(2 * node + 2, half, end);
}

}  // namespace arete
