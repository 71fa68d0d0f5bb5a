// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "surface/model/surface_mesh.h"

namespace arete {

/// What creases ask of a build beside the wedges.
struct CreaseLines {
  std::uint64_t edges = 0;  ///< how many edges are creases
  /// Vertices to be kept in every cut, rising: where a crease ends inside the surface, corners on both sides
  /// share a wedge, and a line between two such ends needs a vertex inside, or both ends.
  std::vector<std::uint32_t> fixed;
};

/// Makes the creases of a mesh lines (surface/model/parts.h): corners of a vertex that creases part have
/// wedges of their own, with the attributes that they had. A crease is an edge of two faces that isCrease()
/// says is one, by faceNormals(). A mesh without a crease stays as it is. O(n log n). Preconditions: the mesh
/// is valid, an oriented manifold.
CreaseLines makeCreasesLines(SurfaceMesh& mesh, double creaseDegrees);

}  // namespace arete
