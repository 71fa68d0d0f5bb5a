// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"

namespace arete::bench {

/// The rivals of stage "surface": CGAL's edge collapse, one thread.
enum class EdgeCollapse {
  lindstromTurk,         ///< memoryless, vertices placed freely
  lindstromTurkNormals,  ///< the same, without steps that turn a triangle over
  lindstromTurkEnds,     ///< the same cost, vertices placed at the better end
  planeQuadrics,         ///< Garland and Heckbert, vertices placed freely
};

struct Collapsed {
  TriangleMesh mesh;
  double seconds = 0;  ///< of the collapse alone
};

/// Collapses edges until at most `triangles` are left, or no edge may be. Errors: invalidData: CGAL cannot
/// hold the mesh as an oriented manifold.
Result<Collapsed> collapseEdges(const TriangleMesh& mesh, std::uint64_t triangles, EdgeCollapse method);

}  // namespace arete::bench
