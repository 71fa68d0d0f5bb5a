// SPDX-License-Identifier: GPL-3.0-or-later
//
// The first fan of a vertex keeps it, each further one gets a copy. A fan at an end of an edge of more than
// two triangles keeps the vertex too: a copy would pull the edge apart, which is splitSheets()' to do.
#include "surface/topology/fans.h"

#include "surface/repair/draft.h"
#include "surface/topology/edges.h"

namespace arete::repair_passes {

void splitFans(Draft& draft) {
  auto& triangles = draft.mesh.triangles;
  decltype(MeshFans::fanOf) fanOf;
  std::vector<std::uint32_t> vertexOfFan;
  {
    const MeshEdges edges(triangles, draft.mesh.positions.size());
    MeshFans fans(edges);
    std::vector<std::uint8_t> keepsVertex(fans.vertexOf.size(), 0);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (edges[e].isManifold()) continue;
      for (const CornerId side : edges[e].sides)
        keepsVertex[fans.fanOf[side.index()].index()] =
            keepsVertex[fans.fanOf[nextCorner(side).index()].index()] = 1;
    }
    // Whether a fan has the vertex already: those that must, else the first one.
    std::vector<std::uint8_t> isTaken(draft.mesh.positions.size(), 0);
    for (std::size_t f = 0; f < keepsVertex.size(); ++f)
      if (keepsVertex[f] != 0) isTaken[fans.vertexOf[f].index()] = 1;
    for (std::size_t f = 0; f < keepsVertex.size(); ++f) {
      const std::uint32_t v = fans.vertexOf[f].index();
      if (keepsVertex[f] != 0 || isTaken[v] == 0) {
        isTaken[v] = 1;
        vertexOfFan.push_back(v);
      } else {
        vertexOfFan.push_back(draft.copyVertex(v));
        ++draft.counts.addedVertices;
      }
    }
    fanOf = std::move(fans.fanOf);
  }
  for (std::size_t c = 0; c < fanOf.size(); ++c) triangles[c / 3][c % 3] = vertexOfFan[fanOf[c].index()];
}

}  // namespace arete::repair_passes
