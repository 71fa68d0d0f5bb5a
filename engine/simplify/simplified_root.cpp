// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/simplify/simplified_root.h"

#include "engine/base/id_array.h"

namespace arete {

SimplifiedRoot rootOf(const LiveMesh& mesh, std::uint32_t levels) {
  SimplifiedRoot root;
  root.levels = levels;
  IdArray<VertexId, std::vector<std::uint8_t>> seen(mesh.vertexCount(), std::uint8_t(0));
  for (const LiveMesh::Triangle& triangle : mesh.triangles) {
    if (triangle.isDead()) continue;
    root.triangles.push_back({triangle.recorderId, triangle.corners});
    for (const VertexId v : triangle.corners) seen[v] = 1;
  }
  for (std::uint32_t v = 0; v < seen.size(); ++v)
    if (seen[VertexId(v)] != 0) root.vertices.push_back(VertexId(v));
  return root;
}

}  // namespace arete
