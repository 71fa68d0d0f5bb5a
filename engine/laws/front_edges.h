// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/cut/cut.h"
#include "engine/memory/uninitialized_vector.h"

namespace arete {

/// The edges of a front and the triangles at each, for checks of conformity and of the Delaunay property.
/// Memory: 8 bytes per side of a triangle.
class FrontEdges {
 public:
  /// Side i of triangle t of the front, from corner i to the next one, is number 3 t + i.
  struct Side {
    std::uint32_t high;  ///< the end with the higher vertex number
    std::uint32_t number;

    std::uint32_t triangle() const { return number / 3; }
    std::uint32_t corner() const { return number % 3; }
    bool operator<(const Side& other) const {
      return high != other.high ? high < other.high : number < other.number;
    }
  };

  /// The triangles need not form a surface. Parallel; O(triangles) if vertices have few edges. Preconditions:
  /// corners are vertices of the front; there are fewer than 2^32 sides, as in every MT.
  explicit FrontEdges(const Cut& front);

  std::uint32_t vertices() const { return static_cast<std::uint32_t>(begin_.size() - 1); }
  /// Calls visit(sides) for every edge whose lower end is `low`, by rising upper end. The sides of an edge
  /// are in the order of their triangles.
  template <class Visit>
  void visitFrom(std::uint32_t low, const Visit& visit) const {
    const std::span<const Side> all(sides_.data() + begin_[low], begin_[low + 1] - begin_[low]);
    for (std::size_t i = 0, j; i < all.size(); i = j) {
      for (j = i + 1; j < all.size() && all[j].high == all[i].high;) ++j;
      visit(all.subspan(i, j - i));
    }
  }

 private:
  UninitializedVector<std::uint32_t> begin_;  ///< the first of each vertex's sides; then the end
  UninitializedVector<Side> sides_;
};

}  // namespace arete
