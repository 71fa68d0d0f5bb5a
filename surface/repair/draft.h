// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/repair/repair.h"

// The passes of repair(). Each works on the draft, keeps what it says of its source, and counts what it
// mends.
namespace arete::repair_passes {

using Triangle = std::array<std::uint32_t, 3>;

/// A mesh in repair.
struct Draft {
  TriangleMesh mesh;
  std::vector<std::uint32_t> vertexOf, triangleOf;  ///< as in RepairedMesh
  /// By triangle: whether it turns against its source.
  std::vector<std::uint8_t> isTurned;
  std::uint64_t turns = 0;  ///< how often any triangle was turned
  RepairCounts counts;
  std::uint64_t openHoles = 0, crossingParts = 0;  ///< as in RepairedMesh, as the last pass found them

  explicit Draft(const TriangleMesh& source);

  /// A copy of a vertex. Returns its number.
  std::uint32_t copyVertex(std::uint32_t vertex);
  /// Adds a triangle that is a part of the source of another one and turns as it does; kNone: of no source.
  void addTriangle(const Triangle& corners, std::uint32_t like);
  void turn(std::uint32_t triangle);
  /// Leaves out the triangles for which isGone[t] is not 0; the others keep their order.
  void removeTriangles(const std::vector<std::uint8_t>& isGone);
  /// Leaves out the vertices that no triangle uses.
  void removeUnusedVertices();
};

void removeDuplicates(Draft& draft);
void removeDegenerate(Draft& draft);
/// The edges that a split makes are joined with those of the same part that lie in their places.
/// @param distance within which a vertex is inside an edge.
/// @param partOf   RepairOptions::partOf
/// @return whether any edge was split.
bool splitAtTJunctions(Draft& draft, double distance, std::span<const std::uint32_t> partOf);
void splitSheets(Draft& draft);
void orient(Draft& draft, const RepairOptions& options);
void splitFans(Draft& draft);
void fillHoles(Draft& draft, std::uint32_t mostEdges);

}  // namespace arete::repair_passes
