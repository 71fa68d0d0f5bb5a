// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace arete {

/// What a change of an attribute counts beside a distance [Hoppe1999].
struct AttributeWeight {
  std::string attribute;  ///< its name in the file, of vertices and of wedges alike
  /// How many diagonals of the mesh a change of 1 counts: texture coordinates and numbers in their own
  /// unit, colours in the range of a channel, directions by the length between them.
  double weight = 0;
};

}  // namespace arete
