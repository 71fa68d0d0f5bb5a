// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace arete {

/// Random numbers that are the same on every machine and every standard library: SplitMix64
/// [SteeleLeaFlood2014], integers only, and doubles made from integers by exact steps.
class Random {
 public:
  constexpr explicit Random(std::uint64_t seed) : state_(seed) {}

  /// SplitMix64's finaliser: a hash of 64 bits, for noise that has no order of evaluation.
  static constexpr std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
    return x ^ (x >> 31);
  }

  /// A hash of a lattice position: the same whatever order the lattice is visited in.
  static constexpr std::uint64_t at(std::uint64_t seed, std::int64_t x, std::int64_t y) {
    return mix(mix(mix(seed + kGamma) + static_cast<std::uint64_t>(x) * kGamma) +
               static_cast<std::uint64_t>(y) * kGamma);
  }

  /// 53 of the bits as a double in [0, 1).
  static constexpr double toUnit(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

  constexpr std::uint64_t next() {
    state_ += kGamma;
    return mix(state_);
  }

  /// In [0, 1).
  constexpr double unit() { return toUnit(next()); }

  /// In [low, high).
  constexpr double between(double low, double high) { return low + (high - low) * unit(); }

  /// In 0 .. bound - 1. Precondition: bound > 0. Biased by less than bound / 2^64.
  constexpr std::uint32_t below(std::uint32_t bound) {
    // A remainder would be as good; the high half is better mixed.
    return static_cast<std::uint32_t>(((next() >> 32) * bound) >> 32);
  }

 private:
  static constexpr std::uint64_t kGamma = 0x9E3779B97F4A7C15ull;
  std::uint64_t state_;
};

}  // namespace arete
