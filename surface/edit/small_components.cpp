// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/edit/small_components.h"

#include <array>
#include <utility>

#include "engine/base/box3.h"
#include "surface/model/transfer.h"
#include "surface/topology/components.h"
#include "surface/topology/edges.h"

namespace arete {
Result<SmallComponents> withoutSmallComponents(const SurfaceMesh& source, double diagonal) {
  constexpr std::uint32_t kNone = MeshAttributes::kNone;
  const MeshEdges edges(source.triangles, source.positions.size());
  const MeshComponents components(edges);
  std::vector<Box3> boxes(components.count, Box3::empty());
  for (std::uint32_t t = 0; t < source.triangles.size(); ++t)
    for (const std::uint32_t v : source.triangles[t])
      boxes[components.componentOf[t]].include(source.positions[v]);
  const auto isSmall = [&](std::uint32_t component) { return boxes[component].diagonal() < diagonal; };
  SmallComponents result;
  for (std::uint32_t c = 0; c < components.count; ++c) result.components += isSmall(c) ? 1 : 0;
  TriangleMesh shape;
  std::vector<std::uint32_t> numberOf(source.positions.size(), kNone);
  for (std::uint32_t t = 0; t < source.triangles.size(); ++t) {
    if (isSmall(components.componentOf[t])) {
      ++result.triangles;
      continue;
    }
    std::array<std::uint32_t, 3> corners = source.triangles[t];
    for (std::uint32_t& v : corners) {
      if (numberOf[v] == kNone) {
        numberOf[v] = static_cast<std::uint32_t>(result.vertexOf.size());
        result.vertexOf.push_back(v);
        shape.positions.push_back(source.positions[v]);
      }
      v = numberOf[v];
    }
    shape.triangles.push_back(corners);
    result.triangleOf.push_back(t);
  }
  ARETE_TRY(SurfaceMesh mesh,
            transferAttributes(source, std::move(shape), result.vertexOf, result.triangleOf));
  result.mesh = std::move(mesh);
  return result;
}

double diagonalOf(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return 0;
  Box3 box = Box3::empty();
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) box.include(mesh.positions[v]);
  return box.diagonal();
}

}  // namespace arete
