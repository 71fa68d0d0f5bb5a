// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/simplify/live_mesh.h"
#include "terrain/triangulation/lattice_plan.h"

namespace arete {

/// Simplifies the rims of NODATA regions. A reflex rim vertex may be removed if the triangle that its removal
/// adds to the domain covers no vertex and is within a plan distance of the original rim
/// [DouglasPeucker1973]. A convex one is never removed, so no valid sample is uncovered.
class Rim {
 public:
  /// Stores the rim of the mesh as the original one. O(triangles). `mesh` and `plan` must outlive the Rim.
  /// @param tolerance the distance, in samples.
  Rim(const LiveMesh& mesh, const LatticePlan& plan, double tolerance);

  /// Whether the reflex rim vertex v may be removed. O(original rim between its neighbours + samples in the
  /// box of the triangle).
  /// @param before, after its rim neighbours: the domain is to the left of before -> v -> after.
  bool mayFill(VertexId before, VertexId v, VertexId after) const;

  /// Reserves both ends of a fill for a level: two fills of one level must not share a rim vertex.
  /// @return false if either end is reserved already; nothing is reserved then.
  bool claim(VertexId before, VertexId after, std::uint32_t level);

  /// Joins the new border edge to the border edge that runs back between the same vertices, if there is one:
  /// then the void between the two has no area left. The edge is not found if both vertices are pinched;
  /// these are never removed, so the slit that remains has no consequence.
  static void closeVoid(LiveMesh& mesh, HalfedgeId newBorderHalfedge);

 private:
  const LiveMesh& mesh_;
  const LatticePlan& plan_;
  double tolerance_;
  IdArray<VertexId, std::vector<VertexId>> originalNext_, originalPrevious_;
  IdArray<VertexId, std::vector<std::uint32_t>> claimedAt_;  // the level
};

}  // namespace arete
