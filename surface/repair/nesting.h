// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/box3.h"
#include "engine/base/triangle_mesh.h"

namespace arete::repair_passes {

/// A closed part of a mesh, which encloses a volume.
struct ClosedPart {
  std::vector<std::uint32_t> triangles;
  Box3 box = Box3::empty();
  double volume = 0;         ///< enclosed, above 0
  std::uint32_t object = 0;  ///< parts of different objects are not nested
};

/// Which closed parts lie in each other.
struct Nesting {
  /// By part: how many parts it lies in.
  std::vector<std::uint32_t> depth;
  /// By part: the lowest part that it crosses, directly or by way of others; itself where it crosses none.
  std::vector<std::uint32_t> crossing;
};

/// Finds which parts lie in each other, by rays from up to 64 vertices of each. A part lies in another one
/// where none of these vertices is outside of it; one with vertices inside and outside crosses it. A vertex
/// on the other part is neither. Sides are decided by exact predicates. O(n log n) for parts that are passed
/// by few rays.
Nesting findNesting(const TriangleMesh& mesh, std::span<const ClosedPart> parts);

}  // namespace arete::repair_passes
