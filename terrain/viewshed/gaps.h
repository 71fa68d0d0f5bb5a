// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

namespace arete {

/// A set of directions as disjoint closed intervals.
class DirectionSet {
 public:
  bool isEmpty() const { return intervals_.empty(); }
  bool has(double u) const {
    const auto after = firstFrom(u);
    return after != intervals_.end() && after->first <= u;
  }
  /// O(log n) where it holds [first, last] already, else O(n).
  void add(double first, double last) {
    if (!(first <= last)) return;
    const auto begin = firstFrom(first);
    if (begin != intervals_.end() && begin->first <= first && last <= begin->last) return;
    auto end = begin;
    while (end != intervals_.end() && end->first <= last) {
      first = std::min(first, end->first);
      last = std::max(last, end->last);
      ++end;
    }
    if (begin == end) {
      intervals_.insert(begin, {first, last});
    } else {
      *begin = {first, last};
      intervals_.erase(begin + 1, end);
    }
  }

 private:
  struct Interval {
    double first, last;
  };
  /// The first that ends at u or later.
  std::vector<Interval>::iterator firstFrom(double u) {
    return std::lower_bound(intervals_.begin(), intervals_.end(), u,
                            [](const Interval& i, double at) { return i.last < at; });
  }
  std::vector<Interval>::const_iterator firstFrom(double u) const {
    return const_cast<DirectionSet*>(this)->firstFrom(u);
  }

  std::vector<Interval> intervals_;  ///< rising
};

/// In which directions of a wedge the terrain has gaps so far: in some surely, in others perhaps.
class ViewshedGaps {
 public:
  bool isEmpty() const { return possible_.isEmpty(); }
  bool isPossible(double u) const { return possible_.has(u); }
  bool isCertain(double u) const { return certain_.has(u); }
  /// There is no terrain over a cell or half of one, which is seen from u0 to u1. A line that cuts its corner
  /// off by less than 1e-9 of a step does not count as over it, and so near to a corner rounding decides, and
  /// whatever else makes directions `corner` uncertain.
  void add(double u0, double u1, double corner) {
    possible_.add(u0 - corner, u1 + corner);
    certain_.add(u0 + corner, u1 - corner);
  }

 private:
  DirectionSet certain_, possible_;
};

}  // namespace arete
