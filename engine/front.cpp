// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle is in the front when its creator is in the cut and its remover is not: one test per slot of the
// cut's nodes, no graph walk. Members are handled in pieces: a first pass marks which slots of each are kept,
// a sum over the pieces gives each its place, a second pass writes what is marked. The order is that of the
// triangle ids, whatever the thread count.
//
// Every vertex that a node of the cut inserts is in the front, so the front's vertices are the root's and one
// per member, in the order of the members.
#include "engine/front.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <memory>
#include <numeric>

namespace arete {

Cut frontOf(const MultiTriangulation& mt, const MemberSet& members) {
  const MtArrays& a = mt.arrays();
  const std::uint32_t roots = mt.rootTriangleCount(), rootVertices = mt.rootVertexCount();
  const auto isKept = [&](std::uint32_t id) { return !members.contains(a.remover[id]); };
  const auto rank = [&](std::uint32_t v) {
    return v < rootVertices ? v : rootVertices + members.rank(v - rootVertices);
  };
  Cut cut;
  cut.nodes = members.size();
  cut.vertices.resize(std::size_t(rootVertices) + members.size());
  std::iota(cut.vertices.begin(), cut.vertices.begin() + rootVertices, 0u);

  // begin[p + 1]: where piece p writes; the root comes first.
  std::vector<std::uint32_t> begin(std::size_t(members.pieces()) + 2, 0);
  for (std::uint32_t t = 0; t < roots; ++t) begin[1] += isKept(t) ? 1 : 0;
  const auto kept = std::make_unique_for_overwrite<std::uint64_t[]>(members.size());
  tbb::parallel_for(std::uint32_t(0), members.pieces(), [&](std::uint32_t piece) {
    std::uint32_t count = 0;
    members.visitPiece(piece, [&](std::uint32_t n, std::uint32_t r) {
      const std::uint32_t first = a.slotBegin[n], slots = a.slotBegin[n + 1] - first;
      assert(slots <= 64);
      std::uint64_t mask = 0;
      for (std::uint32_t i = 0; i < slots; ++i) {
        const std::uint64_t keeps = isKept(roots + first + i) ? 1 : 0;
        mask |= keeps << i;
        count += static_cast<std::uint32_t>(keeps);
      }
      kept[r] = mask;
      cut.vertices[rootVertices + r] = rootVertices + n;
    });
    begin[piece + 2] = count;
  });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  cut.triangles.resize(begin.back());
  cut.ids.resize(begin.back());

  std::vector<std::uint16_t> worst(std::size_t(members.pieces()) + 1, 0);
  std::uint32_t at = 0;
  for (std::uint32_t t = 0; t < roots; ++t) {
    if (!isKept(t)) continue;
    cut.triangles[at] = a.rootTriangles[t];
    cut.ids[at++] = t;
    worst[0] = std::max(worst[0], a.error[t]);
  }
  tbb::parallel_for(std::uint32_t(0), members.pieces(), [&](std::uint32_t piece) {
    std::uint32_t to = begin[piece + 1];
    std::uint16_t pieceWorst = 0;
    members.visitPiece(piece, [&](std::uint32_t n, std::uint32_t r) {
      const std::uint32_t first = a.slotBegin[n], last = a.slotBegin[n + 1] - 1;
      for (std::uint64_t mask = kept[r]; mask != 0; mask &= mask - 1) {
        const std::uint32_t s = first + static_cast<std::uint32_t>(std::countr_zero(mask));
        cut.triangles[to] = {rootVertices + r, rank(a.link[s]), rank(a.link[s < last ? s + 1 : first])};
        cut.ids[to++] = roots + s;
        pieceWorst = std::max(pieceWorst, a.error[roots + s]);
      }
    });
    worst[piece + 1] = pieceWorst;
  });
  cut.achievedError = a.scale.decode(*std::max_element(worst.begin(), worst.end()));
  return cut;
}

Cut frontOfPrefix(const MultiTriangulation& mt, std::uint32_t nodes) {
  return frontOf(mt, MemberSet::prefix(nodes));
}

Cut front(const MultiTriangulation& mt, const NodeSet& closed) {
  return frontOf(mt, MemberSet(closed));
}

}  // namespace arete
