// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace arete {

/// The index of a cell on a Z-order curve [Morton1966]: the bits of x and y interleaved, those of x lower.
/// Increases with x and with y.
constexpr std::uint64_t mortonCode(std::uint32_t x, std::uint32_t y) {
  const auto spread = [](std::uint64_t bits) {
    bits = (bits | bits << 16) & 0x0000FFFF0000FFFF;
    bits = (bits | bits << 8) & 0x00FF00FF00FF00FF;
    bits = (bits | bits << 4) & 0x0F0F0F0F0F0F0F0F;
    bits = (bits | bits << 2) & 0x3333333333333333;
    return (bits | bits << 1) & 0x5555555555555555;
  };
  return spread(x) | spread(y) << 1;
}

/// The same in space, of the lowest 21 bits of each coordinate.
constexpr std::uint64_t mortonCode(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const auto spread = [](std::uint64_t bits) {
    bits = (bits | bits << 32) & 0x001F00000000FFFF;
    bits = (bits | bits << 16) & 0x001F0000FF0000FF;
    bits = (bits | bits << 8) & 0x100F00F00F00F00F;
    bits = (bits | bits << 4) & 0x10C30C30C30C30C3;
    return (bits | bits << 2) & 0x1249249249249249;
  };
  return spread(x & 0x1FFFFF) | spread(y & 0x1FFFFF) << 1 | spread(z & 0x1FFFFF) << 2;
}

}  // namespace arete
