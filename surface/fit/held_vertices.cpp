// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/fit/held_vertices.h"

#include "surface/model/parts.h"
#include "surface/topology/edges.h"

namespace arete {

std::vector<std::uint8_t> heldVertices(const SurfaceMesh& mesh, bool keepsBorders) {
  constexpr std::uint32_t kNone = MeshAttributes::kNone;
  const std::size_t vertices = mesh.positions.size();
  std::vector<std::uint8_t> isHeld(vertices, 0);
  const std::vector<std::uint32_t> parts = partsOf(mesh, mesh.triangles.size());
  // By vertex, what its first triangle has there.
  std::vector<std::uint32_t> first(vertices, kNone), wedge(vertices, kNone);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t v = mesh.triangles[t][c];
      if (first[v] == kNone) {
        first[v] = t;
        if (mesh.hasWedges()) wedge[v] = mesh.wedges[t][c];
        continue;
      }
      if ((mesh.hasWedges() && mesh.wedges[t][c] != wedge[v]) ||
          (!parts.empty() && parts[t] != parts[first[v]]))
        isHeld[v] = 1;
    }
  if (!keepsBorders) return isHeld;
  const MeshEdges edges(mesh.triangles, vertices);
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].isBorder()) isHeld[edges[e].low.index()] = isHeld[edges[e].high.index()] = 1;
  return isHeld;
}

}  // namespace arete
