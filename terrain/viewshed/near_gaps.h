// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/base/vec.h"

namespace arete {

/// Gaps so near to the observer that it may be in one, on its border or at its corner. The directions of
/// their corners are ill-conditioned, so each line is intersected with the gaps as polygons.
class ViewshedNearGaps {
 public:
  bool isEmpty() const { return gaps_.empty(); }
  /// @param radians a bound of the angle between lines and the directions given to towards(); 0 at first.
  void setError(double radians) { error_ = radians; }
  /// Adds a triangle or a square.
  /// @param corners in order, in steps from the observer. The part of it in the directions given to towards()
  ///     is at most two steps away.
  void add(std::span<const Vec2> corners);

  struct Crossing {
    bool isPossible = false, isCertain = false;
  };
  /// @return whether a line in the direction (1, u) is over a gap for more than 1e-9 of a step. O(gaps).
  Crossing towards(double u) const;

 private:
  struct Side {
    Vec2 out;         ///< of length 1
    double distance;  ///< of the observer, positive outside
  };
  struct Gap {
    std::array<Side, 4> sides;
    std::size_t count = 0;

    bool isLeft(Vec2 direction, double error) const;
    double length(Vec2 direction, double margin) const;
  };

  std::vector<Gap> gaps_;
  double error_ = 0;
};

}  // namespace arete
