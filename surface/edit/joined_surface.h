// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "surface/model/surface_mesh.h"
#include "surface/repair/weld.h"

namespace arete {

/// What became of the vertices of a mesh that was joined.
struct JoinedSurface {
  std::vector<std::uint32_t> vertexOf;  ///< by vertex: the vertex before joining whose position it has
  std::uint64_t joinedVertices = 0;     ///< to another one
  std::uint64_t joinedEdges = 0;        ///< pairs of border edges that became one edge
  double farthestMove = 0;              ///< of a vertex
};

/// Joins the vertices of a mesh as weld() does (surface/repair/weld.h), and loses no attribute: what was said
/// of vertices is said of wedges where joined vertices differ. Triangles keep their order. A mesh of which
/// nothing is joined stays as it is. Errors: those of weld(). O(n log n).
Result<JoinedSurface> joinSurface(SurfaceMesh& mesh, const WeldOptions& options = {},
                                  const RunContext& context = {});

/// The number of edges of two triangles that have different wedges at one of its ends or at both, as where a
/// texture is cut apart. O(n log n); O(1) without wedges.
std::uint64_t countSeamEdges(const SurfaceMesh& mesh);

}  // namespace arete
