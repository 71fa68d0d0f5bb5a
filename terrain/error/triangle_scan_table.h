// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace arete {

/// Which samples a small triangle covers, row by row, from a table. Most triangles a build asks about are so
/// small that finding their rows takes longer than comparing the few samples in them.
class TriangleScanTable {
 public:
  /// Row top + k holds size[k] samples from column left[k] on. Both count from the first corner.
  struct Rows {
    static constexpr int kMost = 5, kMostSamples = 4;
    std::int8_t count = -1;  ///< < 0: the table does not have the triangle
    std::int8_t top = 0;
    std::array<std::int8_t, kMost> left{};
    std::array<std::int8_t, kMost> size{};
  };

  /// The table, made when first asked for.
  static const TriangleScanTable& all();

  /// Of a counter-clockwise triangle, by columns and rows of its second and third corner from its first.
  /// Corners are left out, samples on edges are not. O(1).
  const Rows& rows(int bx, int by, int cx, int cy) const {
    const bool isIn = isReached(bx) && isReached(by) && isReached(cx) && isReached(cy);
    return table_[isIn ? place(bx, by, cx, cy) : place(0, 0, 0, 0)];
  }

 private:
  TriangleScanTable();
  static constexpr int kReach = 4, kSide = 2 * kReach + 1;
  static bool isReached(int x) { return static_cast<unsigned>(x + kReach) < static_cast<unsigned>(kSide); }
  static std::size_t place(int bx, int by, int cx, int cy) {
    const int at = ((bx * kSide + by) * kSide + cx) * kSide + cy + kMiddle;
    return static_cast<std::size_t>(at);
  }
  static constexpr int kMiddle = kReach * (((kSide + 1) * kSide + 1) * kSide + 1);

  std::array<Rows, std::size_t(kSide) * kSide * kSide * kSide> table_;
};

}  // namespace arete
