// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/vec.h"

namespace arete {

/// The triangles of a front whose materials let light through, to be drawn the farthest first.
class BlendedOrder {
 public:
  struct Triangle {
    std::array<std::uint32_t, 3> corners{};  ///< drawn vertices
    std::uint32_t material = 0;
    Vec3 middle;  ///< of its corners
  };
  /// Triangles of one material that follow each other.
  struct Run {
    std::uint32_t material = 0, first = 0, count = 0;
  };

  void clear() {
    triangles_.clear();
    order_.clear();
  }
  void add(const Triangle& triangle) { triangles_.push_back(triangle); }
  bool isEmpty() const { return triangles_.empty(); }

  /// Sorts them by the depth of their middles along `forward`; equal ones stay as they were added.
  /// Triangles that cut through each other, or are long beside their distances, may come out of order.
  /// O(n log n).
  void sort(Vec3 eye, Vec3 forward);
  /// As sorted last: three drawn vertices a triangle, and the runs that they fall into.
  std::vector<std::array<std::uint32_t, 3>> corners() const;
  std::vector<Run> runs() const;

 private:
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> order_;  // of drawing
};

}  // namespace arete
