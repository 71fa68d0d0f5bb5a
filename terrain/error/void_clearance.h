// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace arete {

/// A lower bound of the distance from each sample of a raster to the nearest sample without data, kept by
/// blocks of 2 x 2 samples [RosenfeldPfaltz1966]. A quarter of a byte per sample; no memory where all samples
/// are valid.
class VoidClearance {
 public:
  /// O(samples); the search for voids is parallel, the distance transform is not.
  /// @param heights  row by row, NaN for NODATA
  VoidClearance(std::span<const double> heights, std::uint32_t columns);

  bool hasVoids() const { return !blocks_.empty(); }

  /// All samples of the raster within this Chebyshev distance (the larger of columns and rows) are valid.
  /// @return a lower bound of that distance, 506 at most; negative where the sample itself may have no data;
  ///         the largest int32 where the raster has no voids
  std::int32_t at(std::uint32_t column, std::uint32_t row) const {
    if (!hasVoids()) return std::numeric_limits<std::int32_t>::max();
    const std::size_t block = std::size_t(row >> kShift) * columns_ + (column >> kShift);
    return (std::int32_t(blocks_[block]) - 1) << kShift;
  }

 private:
  static constexpr std::uint32_t kShift = 1, kSide = 1u << kShift;
  static constexpr std::uint8_t kFar = 254;

  std::uint32_t columns_;             // of blocks
  std::vector<std::uint8_t> blocks_;  // king's moves to the nearest block with a void, kFar at most
};

}  // namespace arete
