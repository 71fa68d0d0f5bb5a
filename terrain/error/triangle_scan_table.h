// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace arete {

/// A table of the scan conversion of small triangles: which samples each of them covers, row by row. Most
/// triangles that a build evaluates are so small that computing their rows takes longer than comparing the
/// few samples in them.
class TriangleScanTable {
 public:
  /// Row top + k covers size[k] samples from column left[k] on. Rows and columns count from the first corner.
  struct Rows {
    static constexpr int kMost = 5, kMostSamples = 4;
    std::int8_t count = -1;  ///< number of rows; < 0 where the table does not contain the triangle
    std::int8_t top = 0;
    std::array<std::int8_t, kMost> left{};
    std::array<std::int8_t, kMost> size{};
  };

  /// The table. Computed on the first call (some milliseconds); thread-safe.
  static const TriangleScanTable& all();

  /// The rows of a counter-clockwise triangle; samples on edges are covered, corners are left out. O(1).
  /// @param bx, by, cx, cy  columns and rows from its first corner to its second and third
  const Rows& rows(int bx, int by, int cx, int cy) const {
    const bool isIn = isReached(bx) && isReached(by) && isReached(cx) && isReached(cy);
    return table_[isIn ? index(bx, by, cx, cy) : index(0, 0, 0, 0)];
  }

 private:
  TriangleScanTable();
  // Corners of up to this many columns and rows from the first one are in the table.
  static constexpr int kReach = 4, kSide = 2 * kReach + 1;
  static bool isReached(int x) { return static_cast<unsigned>(x + kReach) < static_cast<unsigned>(kSide); }
  static std::size_t index(int bx, int by, int cx, int cy) {
    const int at = ((bx * kSide + by) * kSide + cx) * kSide + cy + kMiddle;
    return static_cast<std::size_t>(at);
  }
  static constexpr int kMiddle = kReach * (((kSide + 1) * kSide + 1) * kSide + 1);

  std::array<Rows, std::size_t(kSide) * kSide * kSide * kSide> table_;
};

}  // namespace arete
