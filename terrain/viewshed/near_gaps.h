// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/base/vec.h"

namespace arete {

/// Gaps so near to the observer that it may be in one, at its border or on its corner, where the directions
/// of its corners say little: each line is cut with them.
class ViewshedNearGaps {
 public:
  bool isEmpty() const { return gaps_.empty(); }
  /// By what angle lines may differ from the directions that are asked about; 0 at first.
  void setError(double radians) { error_ = radians; }
  /// A triangle or a square, its corners one after the other and relative to the observer, in steps.
  /// Precondition: what of it is within the directions asked about is no more than two steps away.
  void add(std::span<const Vec2> corners);

  struct Crossing {
    bool isPossible = false, isCertain = false;
  };
  /// Whether a line in the direction (1, u) is over a gap by more than 1e-9 of a step. O(gaps).
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
