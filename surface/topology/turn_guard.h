// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/vec.h"

namespace arete {

/// Finds the vertices that must not be moved, so that no triangle turns by more than 60 degrees from where it
/// was, and no edge becomes a fold of more than 120 degrees.
class TurnGuard {
 public:
  /// @param triangles must outlive it
  /// @param before where the vertices were. O(n log n)
  TurnGuard(std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const Vec3> before);

  /// Marks the corners of the triangles that have turned too far.
  /// @param after where the vertices are
  /// @param stays by vertex, not 0 = it has not been moved
  /// @return whether a vertex was marked that was not. O(n)
  bool mark(std::span<const Vec3> after, std::span<std::uint8_t> stays) const;

 private:
  std::vector<Vec3> normalsOf(std::span<const Vec3> positions) const;

  std::span<const std::array<std::uint32_t, 3>> triangles_;
  std::vector<Vec3> firstNormals_;
  std::vector<std::array<std::uint32_t, 2>> neighbours_;  // triangles at an edge, but for folds there were
};

}  // namespace arete
