// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace arete {

/// Where the short edges of triangles over a raster cross the edges of its finest triangulation, from a
/// table: most edges that a build asks about are so short that finding their crossings takes longer than the
/// heights there.
class EdgeCrossingTable {
 public:
  /// A crossing with an edge between two samples, other than at one of them.
  struct Crossing {
    std::int32_t from, to;  ///< the samples, counted from the one where the crossing edge starts
    double along;           ///< how far along the crossing edge it lies, 0 .. 1
    double between;         ///< how far from `from` to `to`
  };

  /// Of a raster with so many columns.
  explicit EdgeCrossingTable(std::uint32_t columns);

  static constexpr int kReach = 5;
  static bool isShort(std::int32_t dx, std::int32_t dy) { return isReached(dx) && isReached(dy); }
  /// Of an edge that goes so many columns and rows. Precondition: isShort(dx, dy). O(1).
  std::span<const Crossing> of(std::int32_t dx, std::int32_t dy) const {
    const std::size_t edge = place(dx, dy);
    return {crossings_.data() + first_[edge], crossings_.data() + first_[edge + 1]};
  }

 private:
  static constexpr int kSide = 2 * kReach + 1;
  static bool isReached(std::int32_t x) {
    return static_cast<std::uint32_t>(x + kReach) < static_cast<std::uint32_t>(kSide);
  }
  static std::size_t place(std::int32_t dx, std::int32_t dy) {
    return static_cast<std::size_t>(dy + kReach) * kSide + static_cast<std::size_t>(dx + kReach);
  }

  std::array<std::uint32_t, std::size_t(kSide) * kSide + 1> first_;  // per edge
  std::vector<Crossing> crossings_;
};

}  // namespace arete
