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

/// The differences along an edge: the bound, and the largest of samples on the edge that only one of the
/// triangles beside it covers by itself.
struct EdgeDifference {
  SignedBound bound;
  double error = 0;     ///< |difference| at these samples
  double rounding = 0;  ///< bounds its rounding error
};

}  // namespace arete
