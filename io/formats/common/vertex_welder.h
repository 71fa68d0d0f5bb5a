// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/vec.h"

namespace arete {

/// Maps equal positions to one vertex index, for formats that repeat the corners of every triangle. Indices
/// follow the order of first occurrence. 0 and -0 are equal; nothing else is rounded.
class VertexWelder {
 public:
  /// @param expected A hint for the number of distinct positions.
  explicit VertexWelder(std::size_t expected = 0);

  /// @return The vertex index of the position. Preconditions: finite; fewer than 2^32 - 1 distinct positions
  /// so far. Expected O(1).
  std::uint32_t add(Vec3 position);

  /// @return The distinct positions by vertex index. Empties the welder.
  std::vector<Vec3> take();

 private:
  void grow(std::size_t slots);

  std::vector<Vec3> positions_;
  std::vector<std::uint32_t>
      slots_;  // open addressing; a power of two of them, at most half of them occupied
};

}  // namespace arete
