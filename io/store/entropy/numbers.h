// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>

namespace arete {

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

/// Signed numbers as unsigned ones, small where they are small in magnitude: 0, -1, 1, -2 ... are 0, 1, 2, 3.
inline std::uint64_t zigzag(std::int64_t value) {
  return (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
}
inline std::int64_t unzigzag(std::uint64_t value) {
  return static_cast<std::int64_t>((value >> 1) ^ (~(value & 1) + 1));
}

/// Codes an unsigned number: a symbol with a table, and raw bits. Writers and readers share the code that
/// calls this: Io::code(stream, table, actual) returns the symbol, which a writer gets of actual() and a
/// reader of its stream. `actual` returns the number to the writer.
template <class Io, class Stream, class Actual>
std::uint64_t codeNumber(Io& io, Stream stream, unsigned table, const Actual& actual) {
  std::uint64_t value = 0;
  const unsigned symbol = io.code(stream, table, [&] {
    value = actual();
    return bucketOf(value).symbol;
  });
  if (symbol < 16) return symbol;
  const int bits = rawBitsOf(symbol);
  return bucketValue(symbol, io.raw(bits, value & ((std::uint64_t{1} << bits) - 1)));
}
template <class Io, class Stream>
std::int64_t codeSigned(Io& io, Stream stream, unsigned table, std::int64_t actual) {
  return unzigzag(codeNumber(io, stream, table, [&] { return zigzag(actual); }));
}

}  // namespace arete
