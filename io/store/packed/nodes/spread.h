// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace arete::packed {

/// The ball of a node holds the balls of its descendants. Where descendants are not read, the ball of its star is
/// grown to one that holds them too: by a factor that a page states for each of its runs. A code c stands for
/// the factor 2^(c / 8), the last one for any.

inline constexpr std::uint8_t kMostSpread = 255;

/// The least code whose factor is a fiftieth more than the growth: a reader finds the ball of the star in
/// other arithmetic.
inline std::uint8_t spreadCode(double growth) {
  if (!std::isfinite(growth)) return kMostSpread;
  const double code = std::ceil(8 * std::log2(std::max(growth, 1.0) * 1.02));
  return static_cast<std::uint8_t>(std::clamp(code, 0.0, double{kMostSpread}));
}
inline float spreadFactor(std::uint8_t code) {
  if (code == kMostSpread) return std::numeric_limits<float>::infinity();
  return std::exp2(static_cast<float>(code) / 8) * (1 + 1e-6f);
}

}  // namespace arete::packed
