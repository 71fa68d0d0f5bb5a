// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "terrain/viewshed/horizon.h"

namespace arete {

/// A set of directions (of u) as disjoint closed intervals, in rising order.
class DirectionSet {
 public:
  bool isEmpty() const { return intervals_.empty(); }
  /// O(log n).
  bool has(double u) const {
    const auto after = firstFrom(u);
    return after != intervals_.end() && after->first <= u;
  }
  /// Adds [first, last], and merges the intervals that it meets; nothing if last < first. O(log n) if the set
  /// contains it already, else O(n).
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
  /// @return the first interval that ends at u or later.
  std::vector<Interval>::iterator firstFrom(double u) {
    return std::lower_bound(intervals_.begin(), intervals_.end(), u,
                            [](const Interval& i, double at) { return i.last < at; });
  }
  std::vector<Interval>::const_iterator firstFrom(double u) const {
    return const_cast<DirectionSet*>(this)->firstFrom(u);
  }

  std::vector<Interval> intervals_;
};

/// In which directions of a wedge the terrain has gaps so far: in some surely, in others possibly.
class ViewshedGaps {
 public:
  bool isEmpty() const { return possible_.isEmpty(); }
  bool isPossible(double u) const { return possible_.has(u); }
  bool isCertain(double u) const { return certain_.has(u); }
  /// Adds a cell, or half of one, without terrain, that is seen from u0 to u1.
  /// @param corner by how much in u the ends are uncertain: a line that cuts off less than 1e-9 of a step
  ///     of the cell does not count as over it, and what rounding and map errors do.
  void add(double u0, double u1, double corner) {
    possible_.add(u0 - corner, u1 + corner);
    certain_.add(u0 + corner, u1 - corner);
  }

 private:
  DirectionSet certain_, possible_;
};

/// Directions in which a line may meet the terrain in a single point (a tip) of the skyline.
class ViewshedTips {
 public:
  /// @return whether u is within `corner` of a tip. Most bins have none, which takes O(1); else O(log tips).
  /// @param bin that of u, of the skyline.
  bool has(int bin, double u) const {
    return !directions_.isEmpty() && hasTips_[static_cast<std::size_t>(bin)] != 0 && directions_.has(u);
  }
  /// Adds the directions from u - corner to u + corner.
  void add(const ViewshedHorizon& skyline, double u, double corner) {
    if (directions_.isEmpty()) hasTips_.assign(static_cast<std::size_t>(skyline.binCount()), 0);
    directions_.add(u - corner, u + corner);
    for (int bin = skyline.bin(u - corner); bin <= skyline.bin(u + corner); ++bin)
      hasTips_[static_cast<std::size_t>(bin)] = 1;
  }

 private:
  DirectionSet directions_;
  std::vector<char> hasTips_;  ///< by bin; empty if there are no tips
};

}  // namespace arete
