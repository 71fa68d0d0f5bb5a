// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle is compared row by row, four samples at a time. The rows of a small one are known from a table
// (small_triangles.h). In a larger one the lines through the three edges bound a row, each from its side; a
// bound is rounded to the sample next to it inside, so that the samples exactly on an edge are always
// counted. Triangles come in all shapes, one after the other: branches that ask for their shape cost more
// than the arithmetic that does without. A wide one is looked at by blocks of 8 x 8 samples: most of them
// keep so close to a plane (height_blocks.h) that none of their samples can be the one that differs most.
//
// The difference between a triangle and the finest triangulation is linear on every piece of the overlay of
// the two, so its extremes lie at the overlay's vertices: samples inside the triangle, its corners (where it
// is zero) and crossings of its edges with edges of the finest triangulation: grid columns, grid rows and the
// diagonals of the cells, which run from the upper-left to the lower-right sample and are the lines column -
// row = constant. A short edge's are in a table (short_edges.h). Where a triangle reaches beyond the domain's
// rim, the rim's own half cells add the other diagonals.
#include "terrain/raster_error.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace arete {
namespace {

/// From so many rows on a triangle is looked at by blocks of samples.
constexpr double kFewWideRows = 16;

/// Two doubles that are worked on at once.
using Two = double __attribute__((vector_size(16)));

Two both(double x) {
  return Two{x, x};
}
Two firsts(Two a, Two b) {
  return Two{a[0], b[0]};
}
Two seconds(Two a, Two b) {
  return Two{a[1], b[1]};
}
Two swapped(Two x) {
  return Two{x[1], x[0]};
}
Two larger(Two a, Two b) {
  return a > b ? a : b;
}
Two smaller(Two a, Two b) {
  return a < b ? a : b;
}
double largest(Two x) {
  return larger(x, swapped(x))[0];
}
double smallest(Two x) {
  return smaller(x, swapped(x))[0];
}
Two load(const double* x) {
  return Two{x[0], x[1]};
}
/// The nearest whole numbers, of less than 2^51.
Two nearest(Two x) {
  const Two shift = both(0x1.8p52);
  return (x + shift) - shift;
}

/// The largest of some differences, until one is beyond the limit.
struct LargestDifference {
  double limit;
  Two found = {0, 0};
  void include(Two difference) {
    const Two size = larger(difference, -difference);
    found = size > found ? size : found;  // false for NODATA
  }
  bool isEnough() const { return largest(found) > limit; }
  /// Whether one between the two could change it.
  bool isChangedBy(double low, double high) const { return std::max(high, -low) > largest(found); }
};

/// The largest of some differences either way, until one is beyond the limit.
struct SignedDifferences {
  double limit;
  Two above = {0, 0}, below = {0, 0};
  void include(Two difference) {
    above = difference > above ? difference : above;  // false for NODATA
    below = difference < below ? difference : below;
  }
  bool isEnough() const { return largest(larger(above, -below)) > limit; }
  bool isChangedBy(double low, double high) const { return high > largest(above) || low < smallest(below); }
};

}  // namespace

/// Half of the triangles a build asks about cover one sample beside their corners, or none: by Pick's theorem
/// those of twice the area 1 none, of 2 the middle of an edge, of 3 their centroid, unless an edge has two.
/// Then `difference` is z_plane - z there. Over NODATA, 0.
[[gnu::always_inline]] inline bool RasterError::isSmall(const Corner& a, const Corner& b, const Corner& c,
                                                        double& difference) const {
  const std::int64_t area = std::int64_t(b.x - a.x) * (c.y - a.y) - std::int64_t(b.y - a.y) * (c.x - a.x);
  if (area > 3) return false;
  std::int64_t x, y;
  double z;
  if (area == 2) {
    const bool isAB = (((b.x - a.x) | (b.y - a.y)) & 1) == 0, isBC = (((c.x - b.x) | (c.y - b.y)) & 1) == 0;
    const Corner &u = isAB ? a : c, &v = isAB || isBC ? b : a;
    x = (u.x + v.x) / 2;
    y = (u.y + v.y) / 2;
    z = (u.z + v.z) / 2;
  } else if (area == 3) {
    x = std::int64_t(a.x) + b.x + c.x;
    y = std::int64_t(a.y) + b.y + c.y;
    if (x % 3 != 0 || y % 3 != 0) return false;
    x /= 3;
    y /= 3;
    z = (a.z + b.z + c.z) / 3;
  } else {
    difference = 0;
    return true;
  }
  const double height = heights_[std::size_t(y) * plan_.columns() + std::size_t(x)];
  difference = height == height ? z - height : 0;
  return true;
}

/// Includes z_plane - z at the samples, row after row, until there is enough. The corners are left out: there
/// the plane is the sample.
template <class Differences>
[[gnu::always_inline]] inline void RasterError::compare(const Corner& a, const Corner& b, const Corner& c,
                                                        Differences& differences) const {
  // Corner a is the origin and anchors the plane.
  const Two ab = {double(b.x - a.x), double(b.y - a.y)}, ac = {double(c.x - a.x), double(c.y - a.y)};
  const Two products = ab * swapped(ac);
  const double inverse = 1.0 / (products[0] - products[1]);
  const Two steps = (both(b.z - a.z) * swapped(ac) - both(c.z - a.z) * swapped(ab)) * both(inverse);
  const double stepX = steps[0], stepY = -steps[1];
  const auto planeAt = [&](double x, double y) { return both(a.z + stepX * x + stepY * y); };
  const auto columns = static_cast<std::ptrdiff_t>(plan_.columns());
  const double* origin = heights_.data() + (a.y * columns + a.x);

  // Four samples of a row that begins at z, by their columns from there, or the first `count` of them.
  const Two firstFour[2] = {{0, 1}, {2, 3}};
  const auto compareFew = [&](Two z, const Two(&x)[2], const double* heights, double count)
      __attribute__((always_inline)) {
    const double* end = heights_.data() + heights_.size();
    std::array<double, 4> copy;
    if (end - heights < 4) {
      copy.fill(0);
      std::copy(heights, end, copy.begin());
      heights = copy.data();
    }
    for (int k = 0; k < 2; ++k) {
      const Two difference = z + both(stepX) * x[k] - load(heights + 2 * k);
      differences.include(firstFour[k] < both(count) ? difference : both(0));
    }
  };

  const auto& few = small_.rows(b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y);
  if (few.count >= 0) {
    for (int k = 0; k < few.count; ++k) {
      const int y = few.top + k, left = few.left[k];
      compareFew(planeAt(left, y), firstFour, origin + (y * columns + left), few.size[k]);
      if (differences.isEnough()) return;
    }
    return;
  }

  // What the line through an edge leaves of a row, from the corner on: x >= start + slope y if the triangle
  // turns up along it, -x >= start + slope y if down. The other one is as good as free, both of a level edge.
  constexpr double kFar = 0x1p100;
  const auto orOne = [](Two dy) { return dy + (dy == both(0) ? both(1) : both(0)); };
  const Two bc = ac - ab, mirror = {1, -1};
  const Two rise = seconds(ab, ac), slope = firsts(ab, ac) / orOne(rise);
  const Two slopeAB = both(slope[0]) * mirror, slopeCA = both(slope[1]) * mirror,
            slopeBC = both(bc[0]) / orOne(both(bc[1])) * mirror;
  const Two ifUp = rise < both(0) ? both(0) : both(-kFar), ifDown = rise > both(0) ? both(0) : both(-kFar);
  const Two startAB = firsts(ifUp, ifDown), startCA = seconds(ifDown, ifUp),
            freeBC = both(bc[1]) * mirror < both(0) ? both(0) : both(-kFar);
  const Two startBC = freeBC + (both(ab[0]) * mirror - slopeBC * both(ab[1]));
  // The middle corner is left out of its row: on the side that two edges bound, or as one of two in a row.
  const Two besideMiddle = swapped(startAB + freeBC + startCA) * both(-1 / kFar) - both(1);

  const Two bottom = larger(larger(rise, swapped(rise)), both(0)),
            top = smaller(smaller(rise, swapped(rise)), both(0)),
            middle = rise + swapped(rise) - top - bottom;
  const double first = smaller(top + both(1), middle)[0], last = larger(bottom - both(1), middle)[0];
  /// Columns of a row: the first one, and how many.
  const auto columnsOf = [&](double y) __attribute__((always_inline)) {
    const Two row = both(y);
    const Two bounds =
        nearest(larger(larger(startAB + slopeAB * row, startBC + slopeBC * row), startCA + slopeCA * row) +
                both(roundUp_)) +
        (row == middle ? besideMiddle : both(0));
    return Two{bounds[0], 1 - bounds[0] - bounds[1]};
  };
  const auto compareRow = [&](double y, double left, double count) __attribute__((always_inline)) {
    const Two z = planeAt(left, y);
    const double* heights = origin + static_cast<std::ptrdiff_t>(y * double(columns) + left);
    Two x[2] = {firstFour[0], firstFour[1]};
    for (; count > 4; count -= 4, heights += 4)
      for (int k = 0; k < 2; ++k) {
        differences.include(z + both(stepX) * x[k] - load(heights + 2 * k));
        x[k] += both(4);
      }
    compareFew(z, x, heights, count);
  };
  if (last - first < kFewWideRows) {
    for (double y = first; y <= last; y += 1) {
      const Two row = columnsOf(y);
      compareRow(y, row[0], row[1]);
      if (differences.isEnough()) return;
    }
    return;
  }

  // A wide triangle: one row of blocks after the other.
  constexpr int kSide = HeightBlocks::kSide;
  constexpr double kMiddle = (kSide - 1) / 2.0, kRounding = 0x1p-46;
  const auto extent = [](std::int32_t i, std::int32_t j, std::int32_t k) {
    return double(std::max({i, j, k}) - std::min({i, j, k}) + kSide);
  };
  const double magnitude =
      std::abs(a.z) + std::abs(stepX) * extent(a.x, b.x, c.x) + std::abs(stepY) * extent(a.y, b.y, c.y);
  for (double y = first; y <= last;) {
    const int blockRow = (a.y + static_cast<int>(y)) >> HeightBlocks::kShift;
    const double blockTop = blockRow * kSide - a.y, end = std::min(last + 1, blockTop + kSide);
    std::array<Two, kSide> rows;
    double left = kFar, right = -kFar;
    int count = 0;
    for (double row = y; row < end; row += 1, ++count) {
      const Two columnsOfRow = rows[count] = columnsOf(row);
      if (columnsOfRow[1] <= 0) continue;
      left = std::min(left, columnsOfRow[0]);
      right = std::max(right, columnsOfRow[0] + columnsOfRow[1] - 1);
    }
    if (left <= right) {
      const int lastBlock = (a.x + static_cast<int>(right)) >> HeightBlocks::kShift;
      for (int i = (a.x + static_cast<int>(left)) >> HeightBlocks::kShift; i <= lastBlock; ++i) {
        // What the differences of the block's samples lie between.
        const HeightBlocks::Block& block =
            blocks_.at(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(blockRow));
        const double blockLeft = i * kSide - a.x, blockHeight = double(block.middle);
        const double there = planeAt(blockLeft + kMiddle, blockTop + kMiddle)[0] - blockHeight;
        const double reach =
            kMiddle * (std::abs(stepX - double(block.slopeX)) + std::abs(stepY - double(block.slopeY))) +
            kRounding * (magnitude + std::abs(blockHeight));
        if (!differences.isChangedBy(there - reach - double(block.high), there + reach - double(block.low)))
          continue;
        for (int k = 0; k < count; ++k) {
          const double from = std::max(rows[k][0], blockLeft),
                       to = std::min(rows[k][0] + rows[k][1], blockLeft + kSide);
          if (from < to) compareRow(y + k, from, to - from);
        }
      }
      if (differences.isEnough()) return;
    }
    y = end;
  }
}

double RasterError::maximum(const Corner& a, const Corner& b, const Corner& c, double limit) const {
  double only = 0;
  if (isSmall(a, b, c, only)) return std::abs(only);
  LargestDifference differences{limit};
  compare(a, b, c, differences);
  return largest(differences.found);
}

double RasterError::maximum(const Corner& a, const Corner& b, const Corner& c, double limit,
                            SignedBound& bound) const {
  double only = 0;
  if (isSmall(a, b, c, only)) {
    bound.include(only);
    return std::abs(only);
  }
  SignedDifferences differences{limit};
  compare(a, b, c, differences);
  const double high = largest(differences.above), low = smallest(differences.below);
  bound.above = std::max(bound.above, high);
  bound.below = std::max(bound.below, -low);
  return std::max(high, -low);
}

SignedBound RasterError::alongShortEdge(const Corner& a, const Corner& b) const {
  const double dz = b.z - a.z;
  const double* heights = heights_.data() + (std::size_t(a.y) * plan_.columns() + std::size_t(a.x));
  double high = 0, low = 0;
  for (const ShortEdges::Crossing& crossing : shortEdges_.of(b.x - a.x, b.y - a.y)) {
    const double from = heights[crossing.from], to = heights[crossing.to];
    const double difference = a.z + dz * crossing.along - (from + crossing.between * (to - from));
    high = difference > high ? difference : high;  // false for NODATA
    low = difference < low ? difference : low;
  }
  return {0 - low, high};  // not -low: that would be -0
}

SignedBound RasterError::alongLongEdge(const Corner& a, const Corner& b) const {
  const std::int64_t x0 = a.x, y0 = a.y, dx = b.x - a.x, dy = b.y - a.y;
  // Along a column, a row or a diagonal it crosses edges of the finest triangulation at samples only, which
  // the scan has.
  if (dx == 0 || dy == 0 || (dx == dy && !reachesBeyondRims_)) return {};
  const double z0 = a.z, dz = b.z - a.z;
  const std::size_t columns = plan_.columns();
  double high = 0, low = 0;
  const auto compare = [&](double difference) {
    high = difference > high ? difference : high;
    low = difference < low ? difference : low;
  };

  {
    const double inverseX = 1.0 / double(dx), slope = double(dy) * inverseX;
    const std::int64_t stepX = dx > 0 ? 1 : -1;
    for (std::int64_t k = 1; k < std::abs(dx); ++k) {  // grid columns
      const double t = double(k * stepX) * inverseX, y = double(y0) + slope * double(k * stepX);
      const double base = double(std::int64_t(y)), f = y - base;
      const double* h = heights_.data() + std::size_t(base) * columns + std::size_t(x0 + k * stepX);
      if (f == 0) continue;  // a sample: the scan has it
      compare(z0 + dz * t - (h[0] + f * (h[columns] - h[0])));
    }
    const double inverseY = 1.0 / double(dy), run = double(dx) * inverseY;
    const std::int64_t stepY = dy > 0 ? 1 : -1;
    for (std::int64_t k = 1; k < std::abs(dy); ++k) {  // grid rows
      const double t = double(k * stepY) * inverseY, x = double(x0) + run * double(k * stepY);
      const double base = double(std::int64_t(x)), f = x - base;
      const double* h = heights_.data() + std::size_t(y0 + k * stepY) * columns + std::size_t(base);
      if (f == 0) continue;
      compare(z0 + dz * t - (h[0] + f * (h[1] - h[0])));
    }
  }
  const std::int64_t across = dx - dy;
  if (across != 0 && std::abs(across) > 1) {  // diagonals column - row = constant, through whole cells
    const double inverse = 1.0 / double(across);
    const std::int64_t step = across > 0 ? 1 : -1;
    for (std::int64_t k = 1; k < std::abs(across); ++k) {
      const double t = double(k * step) * inverse;
      const double x = double(x0) + double(dx) * t, y = double(y0) + double(dy) * t;
      // On the diagonal both fractions are the same; take the one that is exact more often.
      const double base = double(std::int64_t(x)), f = x - base;
      if (f == 0) continue;
      const auto row = static_cast<std::int64_t>(y - f + 0.5);
      if (row < 0 || row + 1 >= std::int64_t(rows_) || std::size_t(base) + 1 >= columns) continue;
      const double* h = heights_.data() + std::size_t(row) * columns + std::size_t(base);
      compare(z0 + dz * t - (h[0] + f * (h[columns + 1] - h[0])));
    }
  }
  const std::int64_t along = dx + dy;
  if (reachesBeyondRims_ && std::abs(along) > 1) {
    const double inverse = 1.0 / double(along);
    const std::int64_t step = along > 0 ? 1 : -1;
    for (std::int64_t k = 1; k < std::abs(along); ++k) {
      const double t = double(k * step) * inverse;
      const double x = double(x0) + double(dx) * t, y = double(y0) + double(dy) * t;
      const double base = double(std::int64_t(x)), f = x - base;
      if (f == 0) continue;
      const auto row = static_cast<std::int64_t>(y - (1 - f) + 0.5);
      if (row < 0 || row + 1 >= std::int64_t(rows_) || std::size_t(base) + 1 >= columns) continue;
      const double* h = heights_.data() + std::size_t(row) * columns + std::size_t(base);
      // From the lower-left to the upper-right sample; an edge of the finest triangulation in half cells
      // only.
      const bool isHalfCell = std::isnan(h[0]) != std::isnan(h[columns + 1]);
      if (isHalfCell) compare(z0 + dz * t - (h[columns] + f * (h[1] - h[columns])));
    }
  }
  return {std::max(0.0, -low), std::max(0.0, high)};
}

}  // namespace arete
