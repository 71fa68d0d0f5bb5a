// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/exchange/joined.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "surface/edit/joined_surface.h"

namespace arete {
namespace {

bool isSoup(const TriangleMesh& mesh) {
  if (mesh.triangles.size() < 2 || mesh.positions.size() < 3 * mesh.triangles.size()) return false;
  std::vector<std::uint8_t> isUsed(mesh.positions.size(), 0);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle)
      if (std::exchange(isUsed[v], std::uint8_t{1}) != 0) return false;
  return true;
}

}  // namespace

Status joinSoup(MeshFile& file, const RunContext& context) {
  if (!isSoup(file.mesh)) return {};
  ARETE_TRY(JoinedSurface joined, joinSurface(file.mesh, {.partOf = file.mesh.objectOf}, context));
  file.joinedVertices = joined.joinedVertices;
  if (joined.joinedVertices == 0) return {};
  if (!file.vertexOf.empty())
    for (std::uint32_t& v : joined.vertexOf) v = file.vertexOf[v];
  file.vertexOf = std::move(joined.vertexOf);
  return {};
}

}  // namespace arete
