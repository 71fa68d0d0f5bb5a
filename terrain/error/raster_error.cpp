// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle is scan-converted row by row (triangle_rows.h), four samples at a time. The rows of a small
// triangle come from a table (triangle_scan_table.h). The rows of a wide triangle are scanned by blocks of
// 8 x 8 samples: most blocks lie so close to a plane (height_blocks.h) that none of their samples can differ
// more than what was found before, and these are skipped.
#include "terrain/error/raster_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "terrain/error/double2.h"
#include "terrain/error/exact_error.h"
#include "terrain/error/triangle_rows.h"

namespace arete {
namespace {

using simd::broadcast;
using simd::Double2;

/// The largest |difference| so far; the scan stops once it exceeds the limit.
struct LargestDifference {
  double limit;
  Double2 found = {0, 0};
  void include(Double2 difference) {
    const Double2 size = simd::abs(difference);
    found = size > found ? size : found;  // false for NODATA
  }
  bool isEnough() const { return simd::maxLane(found) > limit; }
  /// Whether a difference within [low, high] could change the result.
  bool isChangedBy(double low, double high) const { return std::max(high, -low) > simd::maxLane(found); }
};

/// The largest and the smallest difference so far; the scan stops once either exceeds the limit.
struct SignedDifferences {
  double limit;
  Double2 above, below;
  void include(Double2 difference) {
    above = difference > above ? difference : above;  // false for NODATA
    below = difference < below ? difference : below;
  }
  bool isEnough() const { return simd::maxLane(simd::max(above, -below)) > limit; }
  bool isChangedBy(double low, double high) const {
    return high > simd::maxLane(above) || low < simd::minLane(below);
  }
};

Vec3 vecOf(const RasterError::Corner& p) {
  return {double(p.x), double(p.y), p.z};
}

/// Where numbers are so small that digits are lost below the least double, no rounding error exceeds this.
constexpr double kTiny = 0x1p-1030;

struct PlaneRounding {
  double bound;  ///< of the rounding error of a difference from the plane, but for that of heights
  double area;   ///< twice the triangle's area, exactly
};

/// The plane is evaluated from rounded steps along columns and rows; the steps of a needle are differences of
/// large numbers, so its bound is large. 0 on level ground.
[[gnu::always_inline]] inline PlaneRounding roundingOfPlane(const RasterError::Corner& a,
                                                            const RasterError::Corner& b,
                                                            const RasterError::Corner& c) {
  const Double2 ab = {double(b.x - a.x), double(b.y - a.y)}, ac = {double(c.x - a.x), double(c.y - a.y)};
  const Double2 crossed = ab * simd::swapLanes(ac), farthest = simd::max(simd::abs(ab), simd::abs(ac));
  const Double2 terms = broadcast(std::abs(b.z - a.z)) * simd::abs(simd::swapLanes(ac)) +
                        broadcast(std::abs(c.z - a.z)) * simd::abs(simd::swapLanes(ab));
  const Double2 products = terms * farthest;
  const double area = crossed[0] - crossed[1];
  return {0x1p-49 * (products[0] + products[1]) / area, area};
}

/// Bounds the rounding error of a difference, but for that of the subtraction of the sample's height.
[[gnu::always_inline]] inline double roundingOf(const PlaneRounding& plane, const RasterError::Corner& a) {
  return plane.bound > 0 ? plane.bound + 0x1p-50 * std::abs(a.z) + kTiny : 0;
}

}  // namespace

/// Half of the triangles that a build evaluates cover one sample beside their corners, or none. By Pick's
/// theorem a triangle of twice the area 1 covers none, of 2 the middle of an edge, of 3 its centroid (or two
/// samples on an edge). Returns true in these cases, with `difference` = z_plane - z at the sample; 0 where
/// there is no sample or no data. `rounding` bounds its rounding error, but for that of the subtraction of z.
[[gnu::always_inline]] inline bool RasterError::isSmall(const Corner& a, const Corner& b, const Corner& c,
                                                        double& difference, double& rounding) const {
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
    rounding = areMiddlesExact_ || u.z == v.z ? 0 : 0x1p-53 * std::abs(z) + kTiny;
  } else if (area == 3) {
    x = std::int64_t(a.x) + b.x + c.x;
    y = std::int64_t(a.y) + b.y + c.y;
    if (x % 3 != 0 || y % 3 != 0) return false;
    x /= 3;
    y /= 3;
    const double rise = (b.z - a.z) + (c.z - a.z), terms = std::abs(b.z - a.z) + std::abs(c.z - a.z);
    z = a.z + rise / 3;  // of flat ground exactly its height
    rounding = terms > 0 ? 0x1p-51 * (terms + std::abs(a.z)) + kTiny : 0;
  } else {
    difference = rounding = 0;
    return true;
  }
  const double height = heights_[std::size_t(y) * plan_.columns() + std::size_t(x)];
  difference = height == height ? z - height : 0;
  return true;
}

/// Feeds z_plane - z at the samples below a triangle to `Differences`. Columns and rows count from corner a,
/// through which the plane is evaluated.
template <class Height, class Differences>
class RasterError::PlaneDifferences {
 public:
  /// `heights`: the first sample of the raster, as doubles or floats.
  [[gnu::always_inline]] PlaneDifferences(const RasterError& errors, const Height* heights, const Corner& a,
                                          double dzB, double dzC, Double2 ab, Double2 ac,
                                          Differences& differences)
      : differences_(differences),
        end_(heights + errors.heights_.size()),
        columns_(errors.plan_.columns()),
        origin_(heights + (a.y * columns_ + a.x)),
        z_(a.z) {
    const Double2 crossed = ab * simd::swapLanes(ac);
    const double inverse = 1.0 / (crossed[0] - crossed[1]);
    const Double2 steps =
        (broadcast(dzB) * simd::swapLanes(ac) - broadcast(dzC) * simd::swapLanes(ab)) * broadcast(inverse);
    stepX_ = steps[0];
    stepY_ = -steps[1];
  }

  double stepX() const { return stepX_; }
  double stepY() const { return stepY_; }
  [[gnu::always_inline]] Double2 planeAt(double x, double y) const {
    return broadcast(z_ + stepX_ * x + stepY_ * y);
  }

  /// Includes `count` samples of row y from column `left` on. Precondition: count <= 4.
  [[gnu::always_inline]] void includeFew(int y, int left, int count) {
    includeFew(planeAt(left, y), kFirstFour, origin_ + (y * columns_ + left), count);
  }
  /// Includes `count` samples of row y from column `left` on, any number.
  [[gnu::always_inline]] void includeRow(double y, double left, double count) {
    const Double2 z = planeAt(left, y);
    const Height* heights = origin_ + static_cast<std::ptrdiff_t>(y * double(columns_) + left);
    Double2 x[2] = {kFirstFour[0], kFirstFour[1]};
    for (; count > 4; count -= 4, heights += 4)
      for (int k = 0; k < 2; ++k) {
        differences_.include(z + broadcast(stepX_) * x[k] - simd::load(heights + 2 * k));
        x[k] += broadcast(4);
      }
    includeFew(z, x, heights, count);
  }

 private:
  static constexpr Double2 kFirstFour[2] = {{0, 1}, {2, 3}};

  /// Includes the first `count` samples from `heights` on. `x`: their columns, counted from where the plane
  /// has the height z.
  [[gnu::always_inline]] void includeFew(Double2 z, const Double2 (&x)[2], const Height* heights,
                                         double count) {
    std::array<Height, 4> copy;
    if (end_ - heights < 4) {
      copy.fill(0);
      std::copy(heights, end_, copy.begin());
      heights = copy.data();
    }
    for (int k = 0; k < 2; ++k) {
      const Double2 difference = z + broadcast(stepX_) * x[k] - simd::load(heights + 2 * k);
      differences_.include(kFirstFour[k] < broadcast(count) ? difference : broadcast(0));
    }
  }

  Differences& differences_;
  const Height* end_;
  std::ptrdiff_t columns_;
  const Height* origin_;
  double z_, stepX_, stepY_;
};

/// Includes z_plane - z at the covered samples, row by row, until `differences` is decided. The corners are
/// left out: there the plane passes through the sample.
template <class Differences>
[[gnu::always_inline]] inline void RasterError::compare(const Corner& a, const Corner& b, const Corner& c,
                                                        Differences& differences) const {
  heights_.with([&](const auto* heights) { compareWith(heights, a, b, c, differences); });
}

template <class Height, class Differences>
[[gnu::always_inline]] inline void RasterError::compareWith(const Height* heights, const Corner& a,
                                                            const Corner& b, const Corner& c,
                                                            Differences& differences) const {
  const Double2 ab = {double(b.x - a.x), double(b.y - a.y)}, ac = {double(c.x - a.x), double(c.y - a.y)};
  PlaneDifferences<Height, Differences> plane(*this, heights, a, b.z - a.z, c.z - a.z, ab, ac, differences);

  const auto& few = scanTable_.rows(b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y);
  if (few.count >= 0) {
    for (int k = 0; k < few.count; ++k) {
      plane.includeFew(few.top + k, few.left[k], few.size[k]);
      if (differences.isEnough()) return;
    }
    return;
  }

  constexpr double kFewWideRows = 48;  // with more rows, scanning by blocks is faster
  const TriangleRows rows(ab, ac, roundUp_);
  if (rows.last() - rows.first() >= kFewWideRows) return compareByBlocks(a, b, c, rows, plane, differences);
  for (double y = rows.first(); y <= rows.last(); y += 1) {
    const Double2 row = rows.columnsOf(y);
    plane.includeRow(y, row[0], row[1]);
    if (differences.isEnough()) return;
  }
}

/// compareWith() for a wide triangle, one row of blocks after the other.
template <class Height, class Differences>
[[gnu::always_inline]] inline void RasterError::compareByBlocks(const Corner& a, const Corner& b,
                                                                const Corner& c, const TriangleRows& triangle,
                                                                PlaneDifferences<Height, Differences>& plane,
                                                                Differences& differences) const {
  constexpr int kSide = HeightBlocks::kSide;
  constexpr double kMiddle = (kSide - 1) / 2.0, kRounding = 0x1p-46, kFar = TriangleRows::kFar;
  const auto extent = [](std::int32_t i, std::int32_t j, std::int32_t k) {
    return double(std::max({i, j, k}) - std::min({i, j, k}) + kSide);
  };
  const double magnitude = std::abs(a.z) + std::abs(plane.stepX()) * extent(a.x, b.x, c.x) +
                           std::abs(plane.stepY()) * extent(a.y, b.y, c.y);
  for (double y = triangle.first(); y <= triangle.last();) {
    const int blockRow = (a.y + static_cast<int>(y)) >> HeightBlocks::kShift;
    const double blockTop = blockRow * kSide - a.y, end = std::min(triangle.last() + 1, blockTop + kSide);
    std::array<Double2, kSide> rows;
    double left = kFar, right = -kFar;
    int count = 0;
    for (double row = y; row < end; row += 1, ++count) {
      const Double2 columnsOfRow = rows[count] = triangle.columnsOf(row);
      if (columnsOfRow[1] <= 0) continue;
      left = std::min(left, columnsOfRow[0]);
      right = std::max(right, columnsOfRow[0] + columnsOfRow[1] - 1);
    }
    if (left <= right) {
      const int lastBlock = (a.x + static_cast<int>(right)) >> HeightBlocks::kShift;
      for (int i = (a.x + static_cast<int>(left)) >> HeightBlocks::kShift; i <= lastBlock; ++i) {
        // An interval that holds the differences of all samples of the block.
        const HeightBlocks::Block& block =
            blocks_.at(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(blockRow));
        const double blockLeft = i * kSide - a.x, blockHeight = double(block.middle);
        const double there = plane.planeAt(blockLeft + kMiddle, blockTop + kMiddle)[0] - blockHeight;
        const double reach = kMiddle * (std::abs(plane.stepX() - double(block.slopeX)) +
                                        std::abs(plane.stepY() - double(block.slopeY))) +
                             kRounding * (magnitude + std::abs(blockHeight));
        if (!differences.isChangedBy(there - reach - double(block.high), there + reach - double(block.low)))
          continue;
        for (int k = 0; k < count; ++k) {
          const double from = std::max(rows[k][0], blockLeft),
                       to = std::min(rows[k][0] + rows[k][1], blockLeft + kSide);
          if (from < to) plane.includeRow(y + k, from, to - from);
        }
      }
      if (differences.isEnough()) return;
    }
    y = end;
  }
}

double RasterError::maximum(const Corner& a, const Corner& b, const Corner& c, double limit) const {
  double only = 0, rounding = 0;
  if (isSmall(a, b, c, only, rounding)) return std::abs(only);
  LargestDifference differences{limit};
  compare(a, b, c, differences);
  return simd::maxLane(differences.found);
}

double RasterError::maximum(const Corner& a, const Corner& b, const Corner& c, double limit,
                            SignedBound& bound, double& rounding) const {
  double only = 0;
  if (isSmall(a, b, c, only, rounding)) {
    if (rounding < leastSmallDifference_ || std::abs(only) > rounding)
      bound.include(only);
    else  // of either sign
      bound.include({rounding, rounding});
    rounding += rounding > 0 || !areMiddlesExact_ ? 0x1p-52 * std::abs(only) : 0;
    return std::abs(only);
  }
  // The signs of differences that are multiples of unit_ / area survive a rounding error below that. Where
  // the unit is fine, differences within the rounding error are looked at again.
  const double start = isUnitCoarse_ ? 0 : roundingOf(roundingOfPlane(a, b, c), a);
  SignedDifferences differences{limit, broadcast(-start), broadcast(start)};
  compare(a, b, c, differences);
  const double high = simd::maxLane(differences.above), low = simd::minLane(differences.below);
  const PlaneRounding ofPlane = roundingOfPlane(a, b, c);
  rounding = roundingOf(ofPlane, a);
  const bool isUnsure = !(rounding * ofPlane.area < unit_ / 4);
  const auto include = [&](double& side, double found, int sign) {
    if (found > 0)
      side = std::max(side, found + ofPlane.bound);
    else if (isUnsure && (isUnitCoarse_ || found > -start) && isAnySampleSigned(a, b, c, sign)) [[unlikely]]
      side = std::max(side, 2 * rounding);
  };
  include(bound.above, high, 1);
  include(bound.below, -low, -1);
  const double error = std::max({high, -low, 0.0});
  rounding += 0x1p-52 * error;
  return error;
}

template <class Visit>
bool RasterError::isAnySample(const Corner& a, const Corner& b, const Corner& c, const Visit& visit) const {
  const std::array corners = {a, b, c};
  const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
  const auto floorOf = [](std::int64_t numerator, std::int64_t denominator) {  // denominator > 0
    return numerator >= 0 ? numerator / denominator : -((denominator - 1 - numerator) / denominator);
  };
  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y, dzB = b.z - a.z,
               dzC = c.z - a.z, area = bx * cy - by * cx;
  const double rounding = 0x1p-49 * (std::abs(dzB) + std::abs(dzC)) + kTiny;
  for (std::int64_t y = top; y <= bottom; ++y) {
    std::int64_t left = std::numeric_limits<std::int64_t>::min(), right = -(left + 1);
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner &from = corners[i], &to = corners[(i + 1) % 3];
      const std::int64_t dx = to.x - from.x, dy = to.y - from.y;
      if (dy > 0) right = std::min(right, from.x + floorOf(dx * (y - from.y), dy));
      if (dy < 0) left = std::max(left, from.x - floorOf(dx * (y - from.y), -dy));
    }
    for (std::int64_t x = left; x <= right; ++x) {
      const double z = heights_[std::size_t(y) * plan_.columns() + std::size_t(x)];
      if (std::isnan(z)) continue;
      // The weights are exact and between 0 and 1.
      const double dx = double(x - a.x), dy = double(y - a.y);
      const double difference = (a.z - z) + ((dx * cy - dy * cx) * dzB + (bx * dy - by * dx) * dzC) / area;
      if (visit(Vec3{double(x), double(y), z}, difference, rounding + 0x1p-51 * std::abs(difference)))
        return true;
    }
  }
  return false;
}

bool RasterError::isAnySampleAbove(const Corner& a, const Corner& b, const Corner& c, double bound) const {
  return isAnySample(a, b, c, [&](const Vec3& sample, double difference, double rounding) {
    return std::abs(difference) + rounding > bound &&
           isErrorAbove(vecOf(a), vecOf(b), vecOf(c), sample, bound);
  });
}

bool RasterError::isAnySampleSigned(const Corner& a, const Corner& b, const Corner& c, int sign) const {
  return isAnySample(a, b, c, [&](const Vec3& sample, double difference, double rounding) {
    return difference * sign > -rounding && signAt(vecOf(a), vecOf(b), vecOf(c), sample) == sign;
  });
}

}  // namespace arete
