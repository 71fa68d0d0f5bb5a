// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace arete {

/// How far the samples of a raster are from those without data, by blocks of 2 x 2: a quarter of a byte a
/// sample, nothing where all are valid.
class VoidClearance {
 public:
  /// `heights`: row by row, NaN for NODATA. O(samples), the search for them parallel.
  VoidClearance(std::span<const double> heights, std::uint32_t columns);

  bool hasVoids() const { return !blocks_.empty(); }

  /// All samples of the raster within this Chebyshev distance (columns or rows, whichever are more) are
  /// valid. Negative where the sample itself may have no data. A bound from below: 506 at most, unless there
  /// are no voids.
  std::int32_t at(std::uint32_t column, std::uint32_t row) const {
    if (!hasVoids()) return std::numeric_limits<std::int32_t>::max();
    const std::size_t block = std::size_t(row >> kShift) * columns_ + (column >> kShift);
    return (std::int32_t(blocks_[block]) - 1) << kShift;
  }

 private:
  static constexpr std::uint32_t kShift = 1, kSide = 1u << kShift;
  static constexpr std::uint8_t kFar = 254;

  std::uint32_t columns_;             // of blocks
  std::vector<std::uint8_t> blocks_;  // a king's moves to the next one with a void, kFar at most
};

}  // namespace arete
