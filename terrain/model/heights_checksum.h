// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "engine/base/vec.h"

namespace arete {

/// heightsChecksum() of heights that come piece by piece, as by rows of a raster.
class HeightsChecksum {
 public:
  /// A raster has its columns and rows, points their number and 0.
  HeightsChecksum(std::uint64_t columns, std::uint64_t rows);
  ~HeightsChecksum();
  HeightsChecksum(const HeightsChecksum&) = delete;
  HeightsChecksum& operator=(const HeightsChecksum&) = delete;

  /// Of points, before their heights.
  void add(std::span<const Vec2> positions);
  /// The next heights, in the order of the samples. O(heights).
  void add(std::span<const double> heights);
  /// "xxh3-128:<hex>". Precondition: all heights were added.
  std::string text() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace arete
