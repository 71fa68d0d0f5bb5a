// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>

namespace arete {

/// The largest float that is at most x. So for a float e, e > x if and only if e > floatAtMost(x).
inline float floatAtMost(double x) {
  if (std::isinf(x)) return static_cast<float>(x);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  if (x >= double(std::numeric_limits<float>::max())) return std::numeric_limits<float>::max();
  const auto f = static_cast<float>(x);
  return double(f) > x ? std::nextafter(f, -kInfinity) : f;
}

/// The least float that is at least x.
inline float floatAtLeast(double x) {
  return -floatAtMost(-x);
}

}  // namespace arete
