// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Chebyshev distance transform of the blocks (a king's moves on a chessboard) in two sequential passes
// [RosenfeldPfaltz1966]: each block takes one more than the least of its neighbours above and to the left,
// then of those below and to the right. A block d moves away from the nearest block with a void is at least
// d - 1 whole blocks of samples away from it.
#include "terrain/error/void_clearance.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "engine/parallel/parallel_loops.h"

namespace arete {

VoidClearance::VoidClearance(std::span<const double> heights, std::uint32_t columns)
    : columns_((columns + kSide - 1) >> kShift) {
  const auto rows = static_cast<std::uint32_t>(heights.size() / columns);
  const std::size_t across = columns_, down = (rows + kSide - 1) >> kShift;
  // A frame of blocks with the largest distance: the passes need no tests at the borders.
  const std::size_t stride = across + 2;
  std::vector<std::uint8_t> framed(stride * (down + 2), kFar);
  std::atomic<bool> hasVoids = false;
  parallelFor(std::size_t(0), down, [&](std::size_t blockRow) {
    std::uint8_t* const blocks = &framed[(blockRow + 1) * stride + 1];
    const std::size_t end = std::min<std::size_t>(rows, (blockRow + 1) * kSide);
    bool isFound = false;
    for (std::size_t row = blockRow * kSide; row < end; ++row)
      for (std::size_t column = 0; column < columns; ++column)
        if (std::isnan(heights[row * columns + column])) {
          blocks[column >> kShift] = 0;
          isFound = true;
        }
    if (isFound) hasVoids.store(true, std::memory_order_relaxed);
  });
  if (!hasVoids) return;

  const auto oneMore = [](std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) {
    return static_cast<std::uint8_t>(std::min({a, b, c, d}) + 1);
  };
  for (std::size_t row = 1; row <= down; ++row) {
    std::uint8_t *const here = &framed[row * stride], *const above = here - stride;
    for (std::size_t i = 1; i <= across; ++i)
      here[i] = std::min(here[i], oneMore(above[i - 1], above[i], above[i + 1], here[i - 1]));
  }
  for (std::size_t row = down; row > 0; --row) {
    std::uint8_t *const here = &framed[row * stride], *const below = here + stride;
    for (std::size_t i = across; i > 0; --i)
      here[i] = std::min(here[i], oneMore(below[i + 1], below[i], below[i - 1], here[i + 1]));
  }
  blocks_.resize(across * down);
  for (std::size_t row = 0; row < down; ++row)
    std::copy_n(&framed[(row + 1) * stride + 1], across, &blocks_[row * across]);
}

}  // namespace arete
