// SPDX-License-Identifier: GPL-3.0-or-later
//
// While vertices are joined, what is said of them is said of wedges, one for each of the soup.
#include "io/exchange/joined.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "surface/model/wedges.h"
#include "surface/repair/weld.h"

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
  SurfaceMesh& mesh = file.mesh;
  if (!isSoup(mesh)) return {};
  Result<WeldedMesh> welded = weld(mesh, {.partOf = mesh.objectOf}, context);
  if (!welded) return tl::unexpected(welded.error());
  const bool hasAttributes = mesh.hasWedges() || !mesh.vertexAttributes.empty();
  if (hasAttributes) moveToWedges(mesh);
  mesh.shape() = std::move(welded->mesh);
  if (hasAttributes) moveToVertices(mesh);
  file.joinedVertices = welded->joinedVertices;
  return {};
}

}  // namespace arete
