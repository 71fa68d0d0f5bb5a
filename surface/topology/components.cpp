// SPDX-License-Identifier: GPL-3.0-or-later
//
// Orientation: a walk over each patch gives every triangle the turn that agrees with the triangle it is
// reached from. Then each edge of two sides either agrees with the turns of both, or its patch has a
// contradiction: the patch is not orientable, whatever the walk.
#include "surface/topology/components.h"

#include <limits>

#include "surface/topology/disjoint_sets.h"

namespace arete {

MeshComponents::MeshComponents(const MeshEdges& edges) {
  DisjointSets sets(edges.triangles().size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto sides = edges[e].sides;
    for (const CornerId side : sides.subspan(1))
      sets.unite(triangleOf(sides[0]).index(), triangleOf(side).index());
  }
  componentOf = sets.numbered(count);
}

MeshOrientation::MeshOrientation(const MeshEdges& edges)
    : patchOf(edges.triangles().size(), std::numeric_limits<std::uint32_t>::max()),
      isTurned(edges.triangles().size(), 0) {
  const auto triangles = static_cast<std::uint32_t>(edges.triangles().size());
  std::vector<TriangleId> reached;
  for (std::uint32_t first = 0; first < triangles; ++first) {
    if (patchOf[first] != std::numeric_limits<std::uint32_t>::max()) continue;
    const auto patch = static_cast<std::uint32_t>(contradiction.size());
    contradiction.push_back(edges.size());
    patchOf[first] = patch;
    reached.assign(1, TriangleId(first));
    while (!reached.empty()) {
      const TriangleId t = reached.back();
      reached.pop_back();
      for (unsigned side = 0; side < 3; ++side) {
        const CornerId own = cornerOf(t, side), beyond = edges.across(own);
        if (!beyond.isValid()) continue;
        const TriangleId u = triangleOf(beyond);
        const bool turns = isTurned[t.index()] != (edges.areOpposed(own, beyond) ? 0 : 1);
        if (patchOf[u.index()] != patch) {
          patchOf[u.index()] = patch;
          isTurned[u.index()] = turns ? 1 : 0;
          reached.push_back(u);
        } else if ((isTurned[u.index()] != 0) != turns && contradiction[patch] == edges.size()) {
          contradiction[patch] = edges.edgeOf(own);
        }
      }
    }
  }
}

}  // namespace arete
