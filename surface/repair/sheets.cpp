// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sides at an edge of more than two triangles are paired into sheets (sheet_pairs.h); one without a
// partner gets a border. Then the corners at a vertex that sheets join keep one vertex, and each further
// group of corners gets a copy.
#include <algorithm>

#include "surface/repair/draft.h"
#include "surface/repair/sheet_pairs.h"
#include "surface/topology/disjoint_sets.h"
#include "surface/topology/edges.h"

namespace arete::repair_passes {
namespace {

std::uint64_t countWide(const TriangleMesh& mesh) {
  const MeshEdges edges(mesh.triangles, mesh.positions.size());
  std::uint64_t wide = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) wide += edges[e].isManifold() ? 0 : 1;
  return wide;
}

}  // namespace

void splitSheets(Draft& draft) {
  auto& triangles = draft.mesh.triangles;
  std::vector<std::uint32_t> vertexOfCorner(3 * triangles.size());
  std::uint64_t wideBefore = 0;
  {
    const MeshEdges edges(triangles, draft.mesh.positions.size());
    DisjointSets sets(vertexOfCorner.size());
    const auto join = [&](CornerId a, CornerId b) {
      const bool areOpposed = edges.areOpposed(a, b);
      sets.unite(a.index(), (areOpposed ? nextCorner(b) : b).index());
      sets.unite(nextCorner(a).index(), (areOpposed ? b : nextCorner(b)).index());
    };
    // A vertex away from such edges stays as it is, however its triangles meet.
    std::vector<std::uint8_t> isConcerned(draft.mesh.positions.size(), 0);
    std::uint64_t wide = 0;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const MeshEdges::Edge edge = edges[e];
      if (edge.sides.size() == 2) join(edge.sides[0], edge.sides[1]);
      if (edge.isManifold()) continue;
      ++wide;
      isConcerned[edge.low.index()] = isConcerned[edge.high.index()] = 1;
      const Vec3 &from = draft.mesh.positions[edge.low.index()],
                 &to = draft.mesh.positions[edge.high.index()];
      std::vector<SheetSide> sides;
      for (const CornerId side : edge.sides)
        sides.push_back({side, draft.mesh.positions[edges.origin(previousCorner(side)).index()],
                         edges.origin(side) == edge.low});
      for (const auto& [a, b] : pairSheets(from, to, sides)) join(a, b);
    }
    if (wide == 0) return;
    wideBefore = wide;
    std::vector<std::uint8_t> isTaken(draft.mesh.positions.size(), 0);
    for (std::uint32_t c = 0; c < vertexOfCorner.size(); ++c) {
      const std::uint32_t v = edges.origin(CornerId(c)).index(), first = sets.find(c);
      if (isConcerned[v] == 0) {
        vertexOfCorner[c] = v;
      } else if (first != c) {
        vertexOfCorner[c] = vertexOfCorner[first];
      } else if (isTaken[v] == 0) {
        isTaken[v] = 1;
        vertexOfCorner[c] = v;
      } else {
        vertexOfCorner[c] = draft.copyVertex(v);
        ++draft.counts.addedVertices;
      }
    }
  }
  for (std::size_t c = 0; c < vertexOfCorner.size(); ++c) triangles[c / 3][c % 3] = vertexOfCorner[c];
  // An edge whose sheets meet again around both of its ends stays one.
  draft.counts.splitSheetEdges += wideBefore - countWide(draft.mesh);
}

}  // namespace arete::repair_passes
