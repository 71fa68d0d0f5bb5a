// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace arete {

/// The largest power of two that divides every height of a heightfield. Where it is not far smaller than the
/// heights, an error in doubles gives the exact error: see RasterError::isAbove().
struct HeightUnit {
  double unit = 0;     ///< 0 where all heights are 0, or where its inverse would overflow
  double largest = 0;  ///< the largest |height|

  /// O(heights), parallel.
  /// @param heights  finite, or NaN for NODATA
  static HeightUnit of(std::span<const double> heights);

  /// Whether the middle of two heights, less a third one, is exact in doubles.
  bool areMiddlesExact() const { return largest < 0x1p50 * unit; }
  /// Whether the heights are so few units that rounding rarely blurs a multiple of unit / area.
  bool isCoarse() const { return largest < 0x1p32 * unit; }
};

}  // namespace arete
