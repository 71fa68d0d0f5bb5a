// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/vec.h"

namespace arete {

/// Gives equal positions one number, for formats that repeat the corners of every triangle. Positions are
/// numbered in the order in which they first come. 0 and -0 are equal, nothing else is rounded.
class VertexWelder {
 public:
  /// `expected`: how many distinct positions may come; a hint.
  explicit VertexWelder(std::size_t expected = 0);

  /// The number of the position. Preconditions: finite; fewer than 2^32 - 1 distinct ones so far. O(1).
  std::uint32_t add(Vec3 position);

  /// The distinct positions, by number; the welder is empty afterwards.
  std::vector<Vec3> take();

 private:
  void grow(std::size_t slots);

  std::vector<Vec3> positions_;
  std::vector<std::uint32_t> slots_;  // open addressing; a power of two of them, at most half of them taken
};

}  // namespace arete
