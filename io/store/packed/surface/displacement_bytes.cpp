// SPDX-License-Identifier: GPL-3.0-or-later
//
// A direction is predicted by the mean of its link's, axis by axis; the length of the link's directions along
// the axis selects the table. Of the triangles that have an error, that of the one before selects the table.
#include "io/store/packed/surface/displacement_bytes.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "io/store/entropy/numbers.h"
#include "io/store/packed/surface/symbol_bytes.h"

namespace arete::packed {
namespace {

constexpr unsigned kLengths = 9, kReachesBefore = 4;
enum DisplacementTable : unsigned {
  kDirectionTable = 0,                       // by the bits of the link's mean length along the axis
  kReachTable = kDirectionTable + kLengths,  // by the reach before
  kDisplacementTables = kReachTable + kReachesBefore
};

unsigned classOf(std::uint8_t reach) {
  return reach == 0 ? 0 : reach < 128 ? 1 : reach < 254 ? 2 : 3;
}

template <class Io>
void codeDirections(const MultiTriangulation& mt, SurfaceDisplacement& d, Io& io) {
  for (std::uint32_t v = 0; v < mt.vertexCount(); ++v)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      int sum = 0, length = 0, count = 0;
      if (v >= mt.rootVertexCount())
        for (const std::uint32_t u : mt.link(NodeId(v - mt.rootVertexCount()))) {
          sum += d.directions[u][axis];
          length += std::abs(d.directions[u][axis]);
          ++count;
        }
      const int predicted = count > 0 ? sum / count : 0;
      const unsigned bits = count > 0
                                ? static_cast<unsigned>(std::bit_width(static_cast<unsigned>(length / count)))
                                : kLengths - 1;
      std::int8_t& value = d.directions[v][axis];
      // Modulo 256, so that damaged bytes are numbers as well.
      value = static_cast<std::int8_t>(
          predicted + codeSigned(io, kSymbols, kDirectionTable + bits, std::int64_t{value} - predicted));
    }
}

template <class Io>
void codeReaches(const MultiTriangulation& mt, SurfaceDisplacement& d, Io& io) {
  unsigned before = 0;
  for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t) {
    if (mt.errorCode(TriangleId(t)) == 0) continue;
    std::uint8_t& reach = d.reaches[t];
    reach = static_cast<std::uint8_t>(io.code(kSymbols, kReachTable + before, [&] { return reach; }));
    before = classOf(reach);
  }
}

}  // namespace

std::vector<std::byte> packDisplacement(const MultiTriangulation& mt,
                                        const SurfaceDisplacement& displacement) {
  SurfaceDisplacement copy = displacement;
  SymbolWriter io(kDisplacementTables);
  codeDirections(mt, copy, io);
  codeReaches(mt, copy, io);
  return io.take();
}

Result<SurfaceDisplacement> unpackDisplacement(std::span<const std::byte> bytes,
                                               const MultiTriangulation& mt) {
  const auto damaged = [] {
    return failure(ErrorCode::corrupt, "the packed displacement is cut short or damaged");
  };
  std::optional<SymbolReader> io = SymbolReader::of(bytes, kDisplacementTables);
  if (!io) return damaged();
  SurfaceDisplacement displacement;
  displacement.directions.resize(mt.vertexCount());
  displacement.reaches.assign(mt.triangleIdCount(), 0);
  codeDirections(mt, displacement, *io);
  codeReaches(mt, displacement, *io);
  if (!io->isAtEnd()) return damaged();
  return displacement;
}

}  // namespace arete::packed
