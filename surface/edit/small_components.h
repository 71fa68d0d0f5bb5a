// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// A mesh without its small components.
struct SmallComponents {
  SurfaceMesh mesh;                                 ///< without them
  std::vector<std::uint32_t> vertexOf, triangleOf;  ///< by vertex and triangle of `mesh`: those of the source
  std::uint64_t components = 0, triangles = 0;      ///< that are left out
};

/// Leaves out the components whose boxes have a diagonal below `diagonal`. Components are what edges join.
/// Errors: those of transferAttributes(). O(triangles), nearly.
Result<SmallComponents> withoutSmallComponents(const SurfaceMesh& source, double diagonal);

/// The diagonal of the box of the vertices that triangles use; 0 without triangles.
double diagonalOf(const TriangleMesh& mesh);

}  // namespace arete
