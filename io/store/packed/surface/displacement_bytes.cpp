// SPDX-License-Identifier: GPL-3.0-or-later
//
// A direction is predicted by the mean of its link's, axis by axis; the length of the link's directions along
// the axis selects the table. Of the triangles that have an error, that of the one before selects the table.
#include "io/store/packed/surface/displacement_bytes.h"

#include <cstdint>
#include <optional>

#include "io/store/packed/surface/displacement_numbers.h"
#include "io/store/packed/surface/symbol_bytes.h"

namespace arete::packed {
namespace {

enum DisplacementTable : unsigned {
  kDirectionTable = 0,
  kReachTable = kDirectionTable + kDirectionLengths,
  kDisplacementTables = kReachTable + kReachClasses
};

template <class Io>
void codeDirections(const MultiTriangulation& mt, SurfaceDisplacement& d, Io& io) {
  for (std::uint32_t v = 0; v < mt.rootVertexCount(); ++v) codeDirection(d, v, {}, kDirectionTable, io);
  for (std::uint32_t n = 0; n < mt.nodeCount(); ++n)
    codeDirection(d, mt.apex(NodeId(n)).index(), mt.link(NodeId(n)), kDirectionTable, io);
}

template <class Io>
void codeReaches(const MultiTriangulation& mt, SurfaceDisplacement& d, Io& io) {
  unsigned before = 0;
  for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t)
    if (mt.errorCode(TriangleId(t)) != 0) codeReach(d.reaches[t], before, kReachTable, io);
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
