// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Numbers of any size, and the root that is told with them. For `Io` see packed_node_coder.h.

#include <cmath>

#include "io/packed/arrays.h"
#include "io/packed/heights.h"
#include "io/packed/numbers.h"
#include "io/packed/tables.h"

namespace arete::packed {

/// Numbers of any size through a table.
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

/// The root, in front of the nodes of chunk 0: every number against the one before it. The writer's arrays
/// hold it already. False when it makes no sense.
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
