// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/edit/small_components.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "surface/model/transfer.h"
#include "surface/topology/components.h"
#include "surface/topology/edges.h"

namespace arete {
namespace {

struct Box {
  Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

  void include(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  double diagonal() const { return std::hypot(high.x - low.x, high.y - low.y, high.z - low.z); }
};

}  // namespace

Result<SmallComponents> withoutSmallComponents(const SurfaceMesh& source, double diagonal) {
  constexpr std::uint32_t kNone = MeshAttributes::kNone;
  const MeshEdges edges(source.triangles, source.positions.size());
  const MeshComponents components(edges);
  std::vector<Box> boxes(components.count);
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
  Result<SurfaceMesh> mesh = transferAttributes(source, std::move(shape), result.vertexOf, result.triangleOf);
  if (!mesh) return tl::unexpected(mesh.error());
  result.mesh = std::move(*mesh);
  return result;
}

double diagonalOf(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return 0;
  Box box;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) box.include(mesh.positions[v]);
  return box.diagonal();
}

}  // namespace arete
