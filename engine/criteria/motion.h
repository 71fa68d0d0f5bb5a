// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <limits>

namespace arete {

/// The motion of a criterion from one frame to another: upper bounds, which add up over frames. A point at
/// distance d from the eye has moved by at most travel + d * turn in the eye's axes.
struct Motion {
  double travel = 0;  ///< of the eye, in metric units
  double turn = 0;    ///< of its axes and of the planes of its frustum, in radians
  double scale = 0;   ///< of the allowed error: the change of its logarithm

  bool isZero() const { return travel == 0 && turn == 0 && scale == 0; }
  bool operator==(const Motion&) const = default;

  /// The least factor by which `unit` covers this motion; infinity if none does.
  double in(const Motion& unit) const {
    const auto times = [](double part, double one) {
      if (part == 0) return 0.0;
      return one > 0 ? part / one : std::numeric_limits<double>::infinity();
    };
    return std::max({times(travel, unit.travel), times(turn, unit.turn), times(scale, unit.scale)});
  }
};

}  // namespace arete
