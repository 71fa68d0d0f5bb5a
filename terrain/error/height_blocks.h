// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace arete {

/// A raster approximated by one plane for each block of 8 x 8 samples, with bounds of the samples' residuals.
/// With them the error of a wide triangle is found without reading most of the samples below it. Takes a
/// twentieth of the memory of the heights.
class HeightBlocks {
 public:
  static constexpr std::uint32_t kShift = 3, kSide = 1u << kShift;

  /// z - (middle + slopeX x + slopeY y) lies in [low, high] at every valid sample; x and y count from the
  /// middle of the block, (3.5, 3.5). low > high for a block without a valid sample.
  struct Block {
    float middle, slopeX, slopeY, low, high;
  };

  /// O(samples), parallel.
  /// @param heights  row by row, NaN for NODATA
  HeightBlocks(std::span<const double> heights, std::uint32_t columns);

  /// @param column, row  of the block: those of any of its samples >> kShift
  const Block& at(std::uint32_t column, std::uint32_t row) const {
    return blocks_[std::size_t(row) * columns_ + column];
  }

 private:
  std::uint32_t columns_;
  std::vector<Block> blocks_;
};

}  // namespace arete
