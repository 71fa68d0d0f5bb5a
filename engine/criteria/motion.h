// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <limits>

namespace arete {

/// How far a criterion has moved, or may: bounds that add up along the way. What lies d from the eye has then
/// moved by at most travel + d * turn in the eye's own axes.
struct Motion {
  double travel = 0;  ///< of the place that it measures from, in metric units
  double turn = 0;    ///< of its axes, and of the planes that bound its sight: radians
  double scale = 0;   ///< of what it allows: the change of the logarithm

  bool isZero() const { return travel == 0 && turn == 0 && scale == 0; }
  bool operator==(const Motion&) const = default;

  /// The least number of times that `unit` must pass to cover this motion. Infinite where it never does.
  double in(const Motion& unit) const {
    const auto times = [](double part, double one) {
      if (part == 0) return 0.0;
      return one > 0 ? part / one : std::numeric_limits<double>::infinity();
    };
    return std::max({times(travel, unit.travel), times(turn, unit.turn), times(scale, unit.scale)});
  }
};

}  // namespace arete
