// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>

namespace arete {

/// The ordinal of a floating-point number is an integer; ordinals are ordered as the numbers are, and those
/// of neighbouring numbers differ by 1.

/// An integer that is ordered as the numbers are (but -0 is less than 0), and its inverse.
inline std::uint64_t ordinal(double x) {
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  return bits >> 63 != 0 ? ~bits : bits | std::uint64_t{1} << 63;
}
inline double fromOrdinal(std::uint64_t o) {
  return std::bit_cast<double>(o >> 63 != 0 ? o & ~(std::uint64_t{1} << 63) : ~o);
}
inline std::uint32_t ordinal(float x) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
  return bits >> 31 != 0 ? ~bits : bits | 1u << 31;
}
inline float fromOrdinal(std::uint32_t o) {
  return std::bit_cast<float>(o >> 31 != 0 ? o & ~(1u << 31) : ~o);
}

}  // namespace arete
