// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/vec.h"

namespace arete {

struct Segment2 {
  Vec2 a, b;
};

/// A bounding volume hierarchy over segments of the plan, queried by box: a balanced binary tree of boxes,
/// split at the median [GoldsmithSalmon1987]. Immutable. Construction: O(n log n). A query: O(log n +
/// segments found), if segments do not overlap much.
class SegmentBvh {
 public:
  SegmentBvh() = default;
  explicit SegmentBvh(std::vector<Segment2> segments);

  bool isEmpty() const { return segments_.empty(); }
  /// Precondition: not empty.
  const Box2& bounds() const { return boxes_.front(); }

  /// Calls visit(segment) for every segment whose bounding box meets `box`, until a call returns true.
  /// @return Whether one did.
  template <class Visit>
  bool anyIn(const Box2& box, const Visit& visit) const {
    return !segments_.empty() && anyBelow(0, 0, size(), box, visit);
  }

 private:
  static constexpr std::uint32_t kLeafSize = 4;

  std::uint32_t size() const { return static_cast<std::uint32_t>(segments_.size()); }
  static std::uint32_t middle(std::uint32_t begin, std::uint32_t end) { return begin + (end - begin) / 2; }
  static bool meet(const Box2& p, const Box2& q) {
    return p.xMin <= q.xMax && q.xMin <= p.xMax && p.yMin <= q.yMax && q.yMin <= p.yMax;
  }
  void build(std::size_t node, std::uint32_t begin, std::uint32_t end);

  // Node i has the children 2 i + 1 and 2 i + 2; a node's segments are the range that halving gives it.
  template <class Visit>
  bool anyBelow(std::size_t node, std::uint32_t begin, std::uint32_t end, const Box2& box,
                const Visit& visit) const {
    if (!meet(boxes_[node], box)) return false;
    if (end - begin > kLeafSize) {
      const std::uint32_t half = middle(begin, end);
      return anyBelow(2 * node + 1, begin, half, box, visit) || anyBelow(2 * node + 2, half, end, box, visit);
    }
    for (std::uint32_t i = begin; i < end; ++i)
      if (meet(boxOf(segments_[i]), box) && visit(segments_[i])) return true;
    return false;
  }
  static Box2 boxOf(const Segment2& s);

  std::vector<Segment2> segments_;
  std::vector<Box2> boxes_;
};

}  // namespace arete
