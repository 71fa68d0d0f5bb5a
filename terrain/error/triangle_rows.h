// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "terrain/error/double2.h"

namespace arete {

/// Scan conversion: which samples of each row of a raster a triangle covers, its edges included and its
/// corners left out. All columns and rows count from corner a.
///
/// The lines through the three edges bound the covered part of a row from the left or from the right. Each
/// bound is rounded inwards to the next sample, so samples exactly on an edge are always counted. The code is
/// free of branches: triangles of all shapes follow each other, and mispredicted branches on the shape cost
/// more than the extra arithmetic.
class TriangleRows {
 public:
  using Double2 = simd::Double2;

  /// @param ab  from corner a to corner b, in columns and rows
  /// @param ac  from corner a to corner c; a, b, c counter-clockwise
  /// @param roundUp  1/2 - 1/(2 rows of the raster): added to a fraction k / rise, rounding to the nearest
  ///        whole number then gives the next one above or equal
  [[gnu::always_inline]] TriangleRows(Double2 ab, Double2 ac, double roundUp)
      : roundUp_(simd::broadcast(roundUp)) {
    const auto orOne = [](Double2 dy) {
      return dy + (dy == simd::broadcast(0) ? simd::broadcast(1) : simd::broadcast(0));
    };
    const Double2 bc = ac - ab, mirror = {1, -1};
    const Double2 rise = simd::highLanes(ab, ac), slope = simd::lowLanes(ab, ac) / orOne(rise);
    slopeAB_ = simd::broadcast(slope[0]) * mirror;
    slopeCA_ = simd::broadcast(slope[1]) * mirror;
    slopeBC_ = simd::broadcast(bc[0]) / orOne(simd::broadcast(bc[1])) * mirror;
    const Double2 ifUp = rise < simd::broadcast(0) ? simd::broadcast(0) : simd::broadcast(-kFar),
                  ifDown = rise > simd::broadcast(0) ? simd::broadcast(0) : simd::broadcast(-kFar);
    const Double2 freeBC =
        simd::broadcast(bc[1]) * mirror < simd::broadcast(0) ? simd::broadcast(0) : simd::broadcast(-kFar);
    startAB_ = simd::lowLanes(ifUp, ifDown);
    startCA_ = simd::highLanes(ifDown, ifUp);
    startBC_ = freeBC + (simd::broadcast(ab[0]) * mirror - slopeBC_ * simd::broadcast(ab[1]));
    besideMiddle_ =
        simd::swapLanes(startAB_ + freeBC + startCA_) * simd::broadcast(-1 / kFar) - simd::broadcast(1);

    const Double2 bottom = simd::max(simd::max(rise, simd::swapLanes(rise)), simd::broadcast(0)),
                  top = simd::min(simd::min(rise, simd::swapLanes(rise)), simd::broadcast(0));
    middle_ = rise + simd::swapLanes(rise) - top - bottom;
    first_ = simd::min(top + simd::broadcast(1), middle_)[0];
    last_ = simd::max(bottom - simd::broadcast(1), middle_)[0];
  }

  /// The first and the last row that can hold covered samples.
  double first() const { return first_; }
  double last() const { return last_; }

  /// @return {first column, number of columns} of row y; the number is <= 0 for an empty row.
  [[gnu::always_inline]] Double2 columnsOf(double y) const {
    const Double2 row = simd::broadcast(y);
    const Double2 bounds =
        simd::roundToNearest(simd::max(simd::max(startAB_ + slopeAB_ * row, startBC_ + slopeBC_ * row),
                                       startCA_ + slopeCA_ * row) +
                             roundUp_) +
        (row == middle_ ? besideMiddle_ : simd::broadcast(0));
    return Double2{bounds[0], 1 - bounds[0] - bounds[1]};
  }

  static constexpr double kFar = 0x1p100;

 private:
  // The line through an edge bounds row y by x >= start + slope y (lane 0) where the edge goes up, and by
  // -x >= start + slope y (lane 1) where it goes down. The start of the other lane, and of both lanes of a
  // level edge, is -kFar: no bound.
  Double2 startAB_, slopeAB_, startBC_, slopeBC_, startCA_, slopeCA_;
  // The row of the corner between the other two in y. That corner is left out of its row by moving the bound
  // on its side by one sample; a triangle with a level edge has two such corners in the row.
  Double2 middle_, besideMiddle_;
  Double2 roundUp_;
  double first_, last_;
};

}  // namespace arete
