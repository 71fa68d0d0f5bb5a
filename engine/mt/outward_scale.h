// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace arete {

/// 16-bit codes for magnitudes (errors and bounds), rounded outwards: decode(encode(x)) >= x.
///
/// A code is the top of an IEEE float: 11 bits of mantissa and 5 of exponent, over the 32 binades that end at
/// the largest magnitude of the model. A magnitude grows by at most one part in 2048; one below largest /
/// 2^31 grows to that floor; zero stays zero. Codes have the order of their magnitudes, so they can be
/// compared without decoding.
class OutwardScale {
 public:
  using Code = std::uint16_t;
  static constexpr Code kMaxCode = 0xFFFF;

  OutwardScale() : OutwardScale(1.0) {}

  /// Every magnitude up to `largest` can be encoded. Precondition: largest is finite, >= 0 and below 1e37.
  explicit OutwardScale(double largest) {
    const double widened = std::fmax(largest, 1e-20) * 1.001;
    const std::uint32_t top = roundedUpBits(widened);
    base_ = top > kMaxCode ? top - kMaxCode : 0;
  }

  static OutwardScale fromBase(std::uint32_t base) {
    OutwardScale scale;
    scale.base_ = base;
    return scale;
  }
  std::uint32_t base() const { return base_; }

  /// The least code whose magnitude is at least x. Precondition: 0 <= x <= decode(kMaxCode).
  Code encode(double x) const {
    // Branch-free: zeros among the triangles of a build are unpredictable.
    const auto code = static_cast<std::int32_t>(roundedUpBits(x) - base_);
    return static_cast<Code>(std::clamp<std::int32_t>(code, 1, kMaxCode) & -std::int32_t(!(x <= 0)));
  }

  /// The largest code whose magnitude is at most x, for "error <= x" as a comparison of codes. x >= 0, may be
  /// infinite.
  Code floorCode(double x) const {
    if (!(x > 0)) return 0;
    if (x >= decode(kMaxCode)) return kMaxCode;
    const Code code = encode(x);
    return decode(code) <= x ? code : static_cast<Code>(code - 1);
  }

  /// Exact in float.
  float decode(Code code) const {
    return code == 0 ? 0.0f : std::bit_cast<float>((base_ + code) << kDroppedBits);
  }

 private:
  static constexpr int kDroppedBits = 12;

  static std::uint32_t roundedUpBits(double x) {
    const auto f = static_cast<float>(x);
    // The next float up is the next integer up.
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(f) + (static_cast<double>(f) < x ? 1 : 0);
    return (bits + ((1u << kDroppedBits) - 1)) >> kDroppedBits;
  }

  std::uint32_t base_ = 0;
};

}  // namespace arete
