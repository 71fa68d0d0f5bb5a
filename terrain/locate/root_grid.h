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

/// Which root triangles lie near a plan point: a grid of about as many cells as there are root triangles,
/// each with a list of the triangles that come within a margin of it. A terrain without NODATA has a handful
/// of root triangles, one with ragged voids tens of thousands. Thread-safe: it is only read.
class RootGrid {
 public:
  /// margin: in plan units, >= 0. O(root triangles + cells they meet).
  RootGrid(const MultiTriangulation& mt, double margin);

  /// Root triangles, by rising id; every one within the margin of p is among them. Empty for a p that is
  /// farther than the margin from all of them, or not finite.
  std::span<const std::uint32_t> near(Vec2 p) const;

  /// The same for all places of a segment, each triangle once, by rising id. O(cells it meets + triangles of
  /// their lists, sorted).
  void along(Vec2 from, Vec2 to, std::vector<std::uint32_t>& triangles) const;

  /// Of the root triangles, without the margin.
  const Box2& bounds() const { return bounds_; }

 private:
  void layCells(double about);
  /// Leaves the length of the list of cell i in begin_[i + 1]. False where the lists hold more than `most`.
  bool countLists(std::span<const std::array<Vec2, 3>> triangles, std::size_t most);
  template <class Visit>
  void forCellsOf(const std::array<Vec2, 3>& triangle, const Visit& visit) const;
  std::uint32_t column(double x) const;
  std::uint32_t row(double y) const;

  Box2 bounds_;
  double margin_ = 0;  // of a list, larger than that of the caller by what rounding takes
  std::uint32_t columns_ = 1, rows_ = 1;
  double cellWidth_ = 1, cellHeight_ = 1;
  std::vector<std::uint32_t> begin_, triangles_;
};

}  // namespace arete
