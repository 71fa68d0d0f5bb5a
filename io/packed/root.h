// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Coding numbers of any size, and the root. For `Io` see node_coder.h: the reader's ignores the actual
// values.

#include <cmath>

#include "io/packed/arrays.h"
#include "io/packed/heights.h"
#include "io/packed/numbers.h"
#include "io/packed/tables.h"

namespace arete::packed {

/// Codes an unsigned number: a symbol with a table, and raw bits. `actual` returns the number to the writer.
template <class Io, class Actual>
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
template <class Io>
std::int64_t codeSigned(Io& io, Stream stream, unsigned table, std::int64_t actual) {
  return unzigzag(codeNumber(io, stream, table, [&] { return zigzag(actual); }));
}

/// Codes the root, before the nodes of packet 0: every number as the difference from the one before it. The
/// writer's arrays hold the root already; the reader's are filled.
/// @return false if the numbers are invalid
template <class Real, class Io>
bool codeRoot(Arrays& a, Io& io) {
  Place<Real>* const place = a.places<Real>();
  const auto wrapped = [](std::uint64_t x, std::int64_t by) { return x + static_cast<std::uint64_t>(by); };
  std::uint64_t sample = 0, x = ordinal(0.0), y = ordinal(0.0);
  double z = 0;
  for (std::uint32_t v = 0; v < a.rootVertices; ++v) {
    if (a.isLattice) {
      sample = wrapped(sample, codeSigned(io, kPlaceStream, kRootPlaceTable,
                                          std::int64_t{a.samples[v]} - static_cast<std::int64_t>(sample)));
      if (sample >= std::uint64_t{a.columns} * a.rows) return false;
      a.samples[v] = static_cast<std::uint32_t>(sample);
      place[v] = {static_cast<Real>(sample % a.columns), static_cast<Real>(sample / a.columns), 0, 0};
    } else {
      x = wrapped(x, codeSigned(io, kPlaceStream, kRootPlaceTable,
                                static_cast<std::int64_t>(ordinal(a.plan[v].x) - x)));
      y = wrapped(y, codeSigned(io, kPlaceStream, kRootPlaceTable,
                                static_cast<std::int64_t>(ordinal(a.plan[v].y) - y)));
      a.plan[v] = {fromOrdinal(x), fromOrdinal(y)};
      place[v] = {static_cast<Real>(a.plan[v].x), static_cast<Real>(a.plan[v].y), 0, 0};
      if (!std::isfinite(a.plan[v].x) || !std::isfinite(a.plan[v].y)) return false;
    }
    const std::int64_t residual =
        codeSigned(io, kHeightStream, kRootHeightTable, heightResidual(a.encoding.type, a.height(v), z));
    z = putHeight(a.encoding.type, a.rawHeights.get(), v, z, residual);
    if (!std::isfinite(z)) return false;
    place[v].z = static_cast<Real>(z);
  }
  std::uint64_t corner = 0;
  for (std::uint32_t t = 0; t < a.roots; ++t)
    for (std::uint32_t& c : a.rootTriangles[t]) {
      corner = wrapped(corner, codeSigned(io, kFloorStream, kRootCornerTable,
                                          std::int64_t{c} - static_cast<std::int64_t>(corner)));
      if (corner >= a.rootVertices) return false;
      c = static_cast<std::uint32_t>(corner);
    }
  a.joinRoot();
  return true;
}

}  // namespace arete::packed
