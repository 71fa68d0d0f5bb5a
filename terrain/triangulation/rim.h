// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/simplify/live_mesh.h"
#include "terrain/triangulation/lattice_plan.h"

namespace arete {

/// Simplifies the rims of NODATA regions: a reflex rim vertex may go when the triangle that its removal adds
/// to the domain covers no vertex and stays within a plan distance of the original rim. A convex one never
/// goes, so no valid sample is ever uncovered.
class Rim {
 public:
  /// tolerance: in samples. Remembers the original rim of the mesh.
  Rim(const LiveMesh& mesh, const LatticePlan& plan, double tolerance);

  /// Whether the reflex rim vertex v between its rim neighbours (domain to the left of before -> v -> after)
  /// may go. O(rim between them + samples of the triangle).
  bool mayFill(std::uint32_t before, std::uint32_t v, std::uint32_t after) const;

  /// Two fills of one level must not share a rim vertex: takes both ends, or returns false.
  bool claim(std::uint32_t before, std::uint32_t after, std::uint32_t level);

  /// Glues the new border edge to the one that runs back between the same vertices, if there is one: the last
  /// triangle of a void is closed. It is found unless both vertices are pinched; these stay for ever, so a
  /// slit between them harms nobody.
  static void closeVoid(LiveMesh& mesh, std::uint32_t newBorderHalfedge);

 private:
  const LiveMesh& mesh_;
  const LatticePlan& plan_;
  double tolerance_;
  std::vector<std::uint32_t> originalNext_, originalPrevious_;
  std::vector<std::uint32_t> claimedAt_;
};

}  // namespace arete
