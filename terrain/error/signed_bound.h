// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

namespace arete {

/// Bounds of the signed vertical difference between a surface and its reference: z_surface - z_reference lies
/// within [-below, above]. Both are >= 0.
struct SignedBound {
  double below = 0;
  double above = 0;

  void include(double difference) {
    above = std::max(above, difference);
    below = std::max(below, -difference);
  }
  void include(const SignedBound& other) {
    above = std::max(above, other.above);
    below = std::max(below, other.below);
  }
};

}  // namespace arete
