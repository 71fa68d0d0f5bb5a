// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/parallel/run_context.h"

namespace arete {

struct WeldOptions {
  /// How far apart vertices may be that are joined; 0: only those at equal positions.
  double distance = 0;
  /// By triangle: the solid or object it belongs to; vertices of different ones are not joined. Empty: all
  /// are one.
  std::span<const std::uint32_t> partOf = {};
};

struct WeldedMesh {
  TriangleMesh mesh;
  std::vector<std::uint32_t> vertexOf;  ///< by vertex: the vertex of the source whose position it has
  std::uint64_t joinedVertices = 0;     ///< how many of the source were joined to another one
  double farthestMove = 0;              ///< of a vertex; at most WeldOptions::distance
  std::uint64_t joinedEdges = 0;        ///< pairs of border edges that became one edge
};

/// Joins a mesh along its borders: two border edges whose ends are at equal positions become one edge, with
/// one vertex at each end. Where more than two border edges lie in one place, those of one connected part are
/// joined, if there are two of them; else those that bound the same solid, by the turns of their triangles.
/// So parts that are whole by themselves and only touch stay apart. An edge gets more than two triangles only
/// where both of its ends lie on seams that two sheets share. Triangles keep their order. Vertices of one
/// triangle are not joined, so none becomes degenerate.
///
/// With a distance, a border vertex within it of another one moves there first, the nearest pairs first; it
/// moves back if no edge is joined there.
///
/// O(n log n), and O(pairs of border vertices within the distance). Errors: invalidData
/// (TriangleMesh::validate(), a part too few or too many), usage (a distance that is negative or not finite;
/// culprit `distance`), unsupported, interrupted, outOfMemory.
Result<WeldedMesh> weld(const TriangleMesh& mesh, const WeldOptions& options = {},
                        const RunContext& context = {});

}  // namespace arete
