// SPDX-License-Identifier: GPL-3.0-or-later
//
// Across an edge with two sides the corners at each of its ends belong to one fan, whichever way the two
// triangles turn.
#include "surface/topology/fans.h"

#include "surface/topology/disjoint_sets.h"

namespace arete {

MeshFans::MeshFans(const MeshEdges& edges) : fanCount(edges.vertexCount(), 0) {
  const std::size_t corners = 3 * edges.triangles().size();
  DisjointSets sets(corners);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const MeshEdges::Edge edge = edges[e];
    if (edge.sides.size() != 2) continue;
    const CornerId a = edge.sides[0], b = edge.sides[1];
    const bool areOpposed = edges.areOpposed(a, b);
    sets.unite(a.index(), (areOpposed ? nextCorner(b) : b).index());
    sets.unite(nextCorner(a).index(), (areOpposed ? b : nextCorner(b)).index());
  }
  std::uint32_t count = 0;
  const UninitializedVector<std::uint32_t> numbers = sets.numbered(count);
  fanOf.resize(corners);
  vertexOf.resize(count);
  for (std::uint32_t c = 0; c < corners; ++c) {
    fanOf[c] = FanId(numbers[c]);
    vertexOf[numbers[c]] = edges.origin(CornerId(c));
  }
  for (const VertexId v : vertexOf) ++fanCount[v.index()];
}

}  // namespace arete
