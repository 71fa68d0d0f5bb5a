// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lowest bit set of a double is the exponent of its last digit plus the zeros at the end of its
// significand.
#include "terrain/error/height_unit.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "engine/parallel/parallel_loops.h"

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

HeightUnit HeightUnit::of(std::span<const double> heights) {
  struct Found {
    int lowest = kNone;
    double largest = 0;
  };
  constexpr std::size_t kHeightsAtOnce = 1 << 16;
  const Found found = parallelReduce(
      IndexRange<std::size_t>(0, heights.size(), kHeightsAtOnce), Found{},
      [&](const auto& part, Found so) {
        for (const double height : heights.subspan(part.begin(), part.size())) {
          so.lowest = std::min(so.lowest, lowestBit(height));
          so.largest = std::abs(height) > so.largest ? std::abs(height) : so.largest;  // false for NODATA
        }
        return so;
      },
      [](const Found& a, const Found& b) {
        return Found{std::min(a.lowest, b.lowest), std::max(a.largest, b.largest)};
      });
  constexpr int kMost = 1000;
  return {std::abs(found.lowest) < kMost ? std::ldexp(1.0, found.lowest) : 0, found.largest};
}

}  // namespace arete
