// SPDX-License-Identifier: GPL-3.0-or-later
//
// While vertices are joined, what is said of them is said of wedges, one for each vertex before.
#include "surface/edit/joined_surface.h"

#include <utility>

#include "engine/base/caught_failure.h"
#include "surface/model/wedges.h"
#include "surface/topology/edges.h"

namespace arete {

Result<JoinedSurface> joinSurface(SurfaceMesh& mesh, const WeldOptions& options,
                                  const RunContext& context) try {
  ARETE_TRY(WeldedMesh welded, weld(mesh, options, context));
  JoinedSurface joined{std::move(welded.vertexOf), welded.joinedVertices, welded.joinedEdges,
                       welded.farthestMove};
  if (joined.joinedVertices == 0) return joined;
  const bool hasAttributes = mesh.hasWedges() || !mesh.vertexAttributes.empty();
  if (hasAttributes) moveToWedges(mesh);
  mesh.shape() = std::move(welded.mesh);
  if (hasAttributes) moveToVertices(mesh);
  return joined;
} catch (...) {
  return caughtFailure();
}

std::uint64_t countSeamEdges(const SurfaceMesh& mesh) {
  if (!mesh.hasWedges()) return 0;
  const MeshEdges edges(mesh.triangles, mesh.positions.size());
  const auto wedgeAt = [&](CornerId c) { return mesh.wedges[c.index() / 3][c.index() % 3]; };
  std::uint64_t seams = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto sides = edges[e].sides;
    if (sides.size() != 2 || triangleOf(sides[0]) == triangleOf(sides[1])) continue;
    CornerId begin = sides[1], end = nextCorner(sides[1]);
    if (edges.areOpposed(sides[0], sides[1])) std::swap(begin, end);
    if (wedgeAt(sides[0]) != wedgeAt(begin) || wedgeAt(nextCorner(sides[0])) != wedgeAt(end)) ++seams;
  }
  return seams;
}

}  // namespace arete
