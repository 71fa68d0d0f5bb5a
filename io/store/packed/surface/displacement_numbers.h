// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "io/store/entropy/numbers.h"
#include "io/store/packed/surface/symbol_bytes.h"
#include "surface/model/displacement.h"

namespace arete::packed {

/// By the bits of the mean length of the link's directions along the axis; the last one is of the root's
/// vertices.
inline constexpr unsigned kDirectionLengths = 9;
/// By the class of the reach before.
inline constexpr unsigned kReachClasses = 4;

/// Codes the direction of a vertex: axis by axis, against the mean of its link's.
/// @param link   empty for a vertex of the root
/// @param table  the first of kDirectionLengths
template <class Io>
void codeDirection(SurfaceDisplacement& d, std::uint32_t vertex, std::span<const std::uint32_t> link,
                   unsigned table, Io& io) {
  const int count = static_cast<int>(link.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    int sum = 0, length = 0;
    for (const std::uint32_t u : link) {
      sum += d.directions[u][axis];
      length += std::abs(d.directions[u][axis]);
    }
    const int predicted = count > 0 ? sum / count : 0;
    const unsigned bits = count > 0
                              ? static_cast<unsigned>(std::bit_width(static_cast<unsigned>(length / count)))
                              : kDirectionLengths - 1;
    std::int8_t& value = d.directions[vertex][axis];
    // Modulo 256, so that damaged bytes are numbers as well.
    value = static_cast<std::int8_t>(predicted +
                                     codeSigned(io, kSymbols, table + bits, std::int64_t{value} - predicted));
  }
}

/// Codes the reach of a triangle that has an error.
/// @param before  the class of the last reach, at first 0; becomes this one's
/// @param table   the first of kReachClasses
template <class Io>
void codeReach(std::uint8_t& reach, unsigned& before, unsigned table, Io& io) {
  reach = static_cast<std::uint8_t>(io.code(kSymbols, table + before, [&] { return reach; }));
  before = reach == 0 ? 0 : reach < 128 ? 1 : reach < 254 ? 2 : 3;
}

}  // namespace arete::packed
