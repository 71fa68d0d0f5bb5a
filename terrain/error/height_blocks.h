// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace arete {

/// Planes that the samples of a raster keep close to, one for each block of 8 x 8. Most blocks under a wide
/// triangle are told by them to hold no sample that matters, at a twentieth of the memory.
class HeightBlocks {
 public:
  static constexpr std::uint32_t kShift = 3, kSide = 1u << kShift;

  /// The samples differ from middle + slopeX x + slopeY y by no less than `low` and no more than `high`; x
  /// and y count from the middle of the block. Of a block without a valid sample low > high.
  struct Block {
    float middle, slopeX, slopeY, low, high;
  };

  /// `heights`: row by row, NaN for NODATA. O(samples), parallel.
  HeightBlocks(std::span<const double> heights, std::uint32_t columns);

  /// Of the samples with these columns and rows, shifted by kShift.
  const Block& at(std::uint32_t column, std::uint32_t row) const {
    return blocks_[std::size_t(row) * columns_ + column];
  }

 private:
  std::uint32_t columns_;
  std::vector<Block> blocks_;
};

}  // namespace arete
