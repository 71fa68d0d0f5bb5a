// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lowest bit set of a double is the exponent of its last digit plus the zeros at the end of its
// significand.
#include "terrain/error/height_unit.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace arete {
namespace {

constexpr int kNone = std::numeric_limits<int>::max();

/// e where 2^e divides the height and 2^(e+1) does not; kNone for 0 and NaN.
int lowestBit(double height) {
  constexpr int kDigits = 52, kBias = 1023;
  constexpr std::uint64_t kImplicit = std::uint64_t{1} << kDigits;
  const auto bits = std::bit_cast<std::uint64_t>(height);
  const int exponent = static_cast<int>(bits >> kDigits) & 0x7FF;
  const std::uint64_t significand = (bits & (kImplicit - 1)) | (exponent > 0 ? kImplicit : 0);
  const bool isNumber = (exponent < 0x7FF) & (significand != 0);
  return isNumber ? std::max(exponent, 1) - kBias - kDigits + std::countr_zero(significand) : kNone;
}

}  // namespace

double commonUnit(std::span<const double> heights) {
  constexpr std::size_t kHeightsAtOnce = 1 << 16;
  const int lowest = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, heights.size(), kHeightsAtOnce), kNone,
      [&](const auto& part, int least) {
        for (const double height : heights.subspan(part.begin(), part.size()))
          least = std::min(least, lowestBit(height));
        return least;
      },
      [](int a, int b) { return std::min(a, b); });
  constexpr int kMost = 1000;
  return std::abs(lowest) < kMost ? std::ldexp(1.0, lowest) : 0;
}

}  // namespace arete
