// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "io/formats/common/file.h"

namespace arete {

/// What follows the coordinates in the "v" lines of an OBJ: a weight, or a colour.
class ObjVertexExtras {
 public:
  /// Takes the numbers behind the coordinates of the next vertex. O(1), amortised.
  ///
  /// @param vertex its index.
  void add(std::size_t vertex, std::span<const double> numbers);

  /// Adds the vertex attribute "color" if some vertices had one, and warnings of what was left out.
  /// O(vertices).
  void finish(MeshFile& file) const;

 private:
  std::vector<double> colors_;  // four for each vertex so far, once there is one
  std::uint64_t colored_ = 0, weights_ = 0, odd_ = 0;
  bool hasAlpha_ = false;
};

/// A number of a colour as an OBJ has it: sRGB, 0 to 1.
struct ObjColorNumber {
  double value;
  bool isFloat32;  ///< it has the digits of a float32
};

/// @param number of the attribute, which may be linear: Attribute::numbers(). The codes of bytes come back
/// as the same codes, through 16 linear bits too.
ObjColorNumber objColorNumber(const Attribute& color, double number);

/// Alpha, which is linear in every format, as a fraction.
double objAlphaOf(const Attribute& color, double number);

}  // namespace arete
