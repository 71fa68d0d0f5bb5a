// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "io/store/entropy/numbers.h"
#include "io/store/packed/surface/symbol_bytes.h"

namespace arete::packed {

/// By how far the numbers of a link are from each other; the last one is of the root's vertices.
inline constexpr unsigned kVertexSpreads = 33;

/// A number that is so far behind another, modulo 2^32; and how far it is.
inline std::uint32_t moved(std::uint32_t x, std::int64_t by) {
  return static_cast<std::uint32_t>(x + static_cast<std::uint64_t>(by));
}
inline std::int64_t behind(std::uint32_t x, std::uint32_t before) {
  return static_cast<std::int32_t>(x - before);
}

/// Codes the number that a node's vertex has in the source, against the middle one of its link's: vertices
/// that are near have near numbers in most files, and in a grid exactly this one.
///
/// @param numbers by vertex; the link has its numbers
/// @param table   the first of kVertexSpreads, by the spread of the link's numbers
/// @param space   is overwritten
template <class Io>
void codeVertexNumber(std::vector<std::uint32_t>& numbers, std::span<const std::uint32_t> link,
                      std::uint32_t apex, unsigned table, Io& io, std::vector<std::uint32_t>& space) {
  space.clear();
  for (const std::uint32_t v : link) space.push_back(numbers[v]);
  std::ranges::sort(space);
  const std::size_t size = space.size();
  const std::uint32_t low = space[(size - 1) / 2], high = space[size / 2], middle = low + (high - low) / 2;
  const auto spread = static_cast<unsigned>(std::bit_width(space[size - 1 - size / 4] - space[size / 4]));
  std::uint32_t& number = numbers[apex];
  number = moved(middle, codeSigned(io, kSymbols, table + spread, behind(number, middle)));
}

}  // namespace arete::packed
