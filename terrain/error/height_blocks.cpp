// SPDX-License-Identifier: GPL-3.0-or-later
//
// A whole block without NODATA gets its least-squares plane, any other block a level one. The quality of a
// plane affects the speed only, never the result: the residuals are computed from the coefficients as they
// are stored (rounded to float), and their bounds are rounded outwards.
#include "terrain/error/height_blocks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/parallel/parallel_loops.h"

namespace arete {
namespace {

constexpr std::uint32_t kSide = HeightBlocks::kSide;
constexpr double kMiddle = (kSide - 1) / 2.0;

/// The block of rows x columns samples that begins at `heights`, with rows `stride` apart.
HeightBlocks::Block blockOf(const double* heights, std::size_t stride, std::uint32_t columns,
                            std::uint32_t rows) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double sum = 0, sumX = 0, sumY = 0, least = kInfinity, most = -kInfinity;
  for (std::uint32_t y = 0; y < rows; ++y)
    for (std::uint32_t x = 0; x < columns; ++x) {
      const double z = heights[y * stride + x];
      sum += z;
      sumX += (x - kMiddle) * z;
      sumY += (y - kMiddle) * z;
      least = z < least ? z : least;
      most = z > most ? z : most;
    }
  HeightBlocks::Block block{};
  if (columns == kSide && rows == kSide && !std::isnan(sum)) {
    constexpr double kSquares = kSide * kSide * (kSide * kSide - 1) / 12.0;
    block.middle = static_cast<float>(sum / (kSide * kSide));
    block.slopeX = static_cast<float>(sumX / kSquares);
    block.slopeY = static_cast<float>(sumY / kSquares);
  } else if (least <= most) {
    block.middle = static_cast<float>((least + most) / 2);
  }
  double low = kInfinity, high = -kInfinity;
  for (std::uint32_t y = 0; y < rows; ++y)
    for (std::uint32_t x = 0; x < columns; ++x) {
      const double difference =
          heights[y * stride + x] - (double(block.middle) + double(block.slopeX) * (x - kMiddle) +
                                     double(block.slopeY) * (y - kMiddle));
      low = difference < low ? difference : low;
      high = difference > high ? difference : high;
    }
  constexpr float kFar = std::numeric_limits<float>::infinity();
  if (!std::isfinite(block.middle + block.slopeX + block.slopeY)) return {0, 0, 0, -kFar, kFar};
  block.low = std::nextafter(static_cast<float>(low), -kFar);
  block.high = std::nextafter(static_cast<float>(high), kFar);
  return block;
}

}  // namespace

HeightBlocks::HeightBlocks(std::span<const double> heights, std::uint32_t columns)
    : columns_((columns + kSide - 1) >> kShift) {
  const auto rows = static_cast<std::uint32_t>(heights.size() / columns),
             blockRows = (rows + kSide - 1) >> kShift;
  blocks_.resize(std::size_t(columns_) * blockRows);
  parallelFor(std::uint32_t(0), blockRows, [&](std::uint32_t row) {
    for (std::uint32_t column = 0; column < columns_; ++column)
      blocks_[std::size_t(row) * columns_ + column] =
          blockOf(heights.data() + std::size_t(row) * kSide * columns + column * kSide, columns,
                  std::min(kSide, columns - column * kSide), std::min(kSide, rows - row * kSide));
  });
}

}  // namespace arete
