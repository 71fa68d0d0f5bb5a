// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/vec.h"
#include "engine/mt/multitriangulation.h"

namespace arete {

/// A uniform grid over the root triangles, for finding those near a plan point: about as many cells as root
/// triangles, each with a list of the triangles within a margin of it. A terrain without NODATA has a handful
/// of root triangles, one with ragged voids tens of thousands. Thread-safe: all queries are const.
class RootGrid {
 public:
  /// O(root triangles + cells they meet).
  /// @param margin  in plan units, >= 0
  RootGrid(const MultiTriangulation& mt, double margin);

  /// The candidates near a point: every root triangle within the margin of p, and others.
  /// @return ids, rising; empty where p is not finite or outside bounds() by more than the margin
  std::span<const TriangleId> near(Vec2 p) const;

  /// The candidates near any point of a segment. O(c + t log t) for c cells on the segment and t entries in
  /// their lists.
  /// @param triangles  receives ids, rising, each once
  void along(Vec2 from, Vec2 to, std::vector<TriangleId>& triangles) const;

  /// The bounding box of the root triangles, without the margin.
  const Box2& bounds() const { return bounds_; }

 private:
  void layCells(double about);
  /// Stores the length of the list of cell i in begin_[i + 1]. False where the lists together exceed `most`.
  bool countLists(std::span<const std::array<Vec2, 3>> triangles, std::size_t most);
  template <class Visit>
  void forCellsOf(const std::array<Vec2, 3>& triangle, const Visit& visit) const;
  std::uint32_t column(double x) const;
  std::uint32_t row(double y) const;

  Box2 bounds_;
  double margin_ = 0;  // the caller's margin and an allowance for rounding
  std::uint32_t columns_ = 1, rows_ = 1;
  double cellWidth_ = 1, cellHeight_ = 1;
  std::vector<std::uint32_t> begin_;  // per cell, and the end
  std::vector<TriangleId> triangles_;
};

}  // namespace arete
