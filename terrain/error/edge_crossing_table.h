// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace arete {

/// A table of the points where short edges between samples of a raster cross the edges of its finest
/// triangulation. Most edges that a build evaluates are so short that computing their crossings takes longer
/// than comparing the heights there.
class EdgeCrossingTable {
 public:
  /// A crossing with an edge between two samples, in its interior.
  struct Crossing {
    std::int32_t from, to;  ///< the two samples, as offsets from the sample where the short edge starts
    double along;           ///< position on the short edge, 0 .. 1
    double between;         ///< position between `from` and `to`, 0 .. 1
  };

  /// @param columns  of the raster
  explicit EdgeCrossingTable(std::uint32_t columns);

  /// Edges of up to this many columns and rows are in the table.
  static constexpr int kReach = 5;
  static bool isShort(std::int32_t dx, std::int32_t dy) { return isReached(dx) && isReached(dy); }
  /// The crossings of an edge of dx columns and dy rows. Precondition: isShort(dx, dy). O(1).
  std::span<const Crossing> of(std::int32_t dx, std::int32_t dy) const {
    const std::size_t edge = index(dx, dy);
    return {crossings_.data() + first_[edge], crossings_.data() + first_[edge + 1]};
  }

 private:
  static constexpr int kSide = 2 * kReach + 1;
  static bool isReached(std::int32_t x) {
    return static_cast<std::uint32_t>(x + kReach) < static_cast<std::uint32_t>(kSide);
  }
  static std::size_t index(std::int32_t dx, std::int32_t dy) {
    return static_cast<std::size_t>(dy + kReach) * kSide + static_cast<std::size_t>(dx + kReach);
  }

  std::array<std::uint32_t, std::size_t(kSide) * kSide + 1> first_;  // per edge: its first crossing
  std::vector<Crossing> crossings_;
};

}  // namespace arete
