// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>

namespace arete::packed {

/// Whole numbers of any size as a symbol of at most 256 kinds and raw bits.

/// A number's symbol and how many raw bits follow it. A number below 16 is its own symbol. The symbol of any
/// other number of w bits is 16 + 4 (w - 5) + the two bits behind the leading one; the other w - 3 bits are
/// raw.
struct Bucket {
  unsigned symbol;
  int rawBits;
};
inline Bucket bucketOf(std::uint64_t value) {
  if (value < 16) return {static_cast<unsigned>(value), 0};
  const int width = std::bit_width(value);
  return {static_cast<unsigned>(16 + (width - 5) * 4 + static_cast<int>((value >> (width - 3)) & 3)),
          width - 3};
}
/// The raw bits that follow a symbol.
inline int rawBitsOf(unsigned symbol) {
  return symbol < 16 ? 0 : static_cast<int>(symbol - 16) / 4 + 2;
}
/// The number of a symbol and its raw bits.
inline std::uint64_t bucketValue(unsigned symbol, std::uint64_t raw) {
  if (symbol < 16) return symbol;
  return (std::uint64_t{4 | ((symbol - 16) & 3)} << rawBitsOf(symbol)) | raw;
}

/// The nearest whole number, halves upwards. Precondition: below 2^62 in magnitude.
inline std::int64_t nearest(double x) {
  const double shifted = x + 0.5;
  const auto whole = static_cast<std::int64_t>(shifted);
  return whole - (static_cast<double>(whole) > shifted ? 1 : 0);
}

/// Signed numbers as unsigned ones, small where they are small in magnitude: 0, -1, 1, -2 ... are 0, 1, 2, 3.
inline std::uint64_t zigzag(std::int64_t value) {
  return (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
}
inline std::int64_t unzigzag(std::uint64_t value) {
  return static_cast<std::int64_t>((value >> 1) ^ (~(value & 1) + 1));
}

}  // namespace arete::packed
