// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "terrain/error/double2.h"

namespace arete {

/// Which samples of a raster's rows a triangle covers, its edges included and its corners left out. All
/// columns and rows count from corner a.
///
/// The lines through the three edges bound a row, each from its side; a bound is rounded to the sample next
/// to it inside, so that the samples exactly on an edge are always counted. Triangles come in all shapes, one
/// after the other: branches that ask for their shape cost more than the arithmetic that does without.
class TriangleRows {
 public:
  /// ab, ac: to corners b and c, counter-clockwise. roundUp: what takes a fraction of a rise in rows to the
  /// next whole number, as the nearest one to the sum.
  [[gnu::always_inline]] TriangleRows(Double2 ab, Double2 ac, double roundUp) : roundUp_(both(roundUp)) {
    const auto orOne = [](Double2 dy) { return dy + (dy == both(0) ? both(1) : both(0)); };
    const Double2 bc = ac - ab, mirror = {1, -1};
    const Double2 rise = seconds(ab, ac), slope = firsts(ab, ac) / orOne(rise);
    slopeAB_ = both(slope[0]) * mirror;
    slopeCA_ = both(slope[1]) * mirror;
    slopeBC_ = both(bc[0]) / orOne(both(bc[1])) * mirror;
    const Double2 ifUp = rise < both(0) ? both(0) : both(-kFar),
                  ifDown = rise > both(0) ? both(0) : both(-kFar);
    const Double2 freeBC = both(bc[1]) * mirror < both(0) ? both(0) : both(-kFar);
    startAB_ = firsts(ifUp, ifDown);
    startCA_ = seconds(ifDown, ifUp);
    startBC_ = freeBC + (both(ab[0]) * mirror - slopeBC_ * both(ab[1]));
    besideMiddle_ = swapped(startAB_ + freeBC + startCA_) * both(-1 / kFar) - both(1);

    const Double2 bottom = larger(larger(rise, swapped(rise)), both(0)),
                  top = smaller(smaller(rise, swapped(rise)), both(0));
    middle_ = rise + swapped(rise) - top - bottom;
    first_ = smaller(top + both(1), middle_)[0];
    last_ = larger(bottom - both(1), middle_)[0];
  }

  /// The first and the last row that can hold such samples.
  double first() const { return first_; }
  double last() const { return last_; }

  /// The first column of a row, and how many.
  [[gnu::always_inline]] Double2 columnsOf(double y) const {
    const Double2 row = both(y);
    const Double2 bounds = nearest(larger(larger(startAB_ + slopeAB_ * row, startBC_ + slopeBC_ * row),
                                          startCA_ + slopeCA_ * row) +
                                   roundUp_) +
                           (row == middle_ ? besideMiddle_ : both(0));
    return Double2{bounds[0], 1 - bounds[0] - bounds[1]};
  }

  static constexpr double kFar = 0x1p100;

 private:
  // What the line through an edge leaves of a row, from the corner on: x >= start + slope y if the triangle
  // turns up along it, -x >= start + slope y if down. The other one is as good as free, both of a level edge.
  Double2 startAB_, slopeAB_, startBC_, slopeBC_, startCA_, slopeCA_;
  // The middle corner is left out of its row: on the side that two edges bound, or as one of two in a row.
  Double2 middle_, besideMiddle_;
  Double2 roundUp_;
  double first_, last_;
};

}  // namespace arete
