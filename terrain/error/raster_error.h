// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "engine/simplify/live_mesh.h"
#include "terrain/error/edge_crossing_table.h"
#include "terrain/error/height_blocks.h"
#include "terrain/error/height_unit.h"
#include "terrain/error/sample_heights.h"
#include "terrain/error/signed_bound.h"
#include "terrain/error/triangle_scan_table.h"
#include "terrain/error/void_clearance.h"
#include "terrain/triangulation/lattice_plan.h"

namespace arete {

class TriangleRows;

/// The exact vertical error of triangles over a raster: every sample that a triangle covers, its edges
/// included, is compared with the triangle's plane. Triangles are planar in (column, row). Samples without
/// data are skipped. Thread-safe: all queries are const.
class RasterError {
 public:
  /// Whether maximum() includes the samples on a triangle's edges.
  static constexpr bool kCoversEdges = true;
  /// A sample: its column, row and height.
  struct Corner {
    std::int32_t x, y;
    double z;
  };
  Corner corner(VertexId vertex) const {
    const LatticePlan::Cell cell = plan_.cell(vertex);
    return {static_cast<std::int32_t>(cell.column), static_cast<std::int32_t>(cell.row),
            heights_[vertex.index()]};
  }

  /// The hole that a removed vertex (the apex) leaves: geometry and errors of the triangles that may fill it.
  /// Triangles are given by the indices of their corners in the apex's link.
  class Hole {
   public:
    Hole(const RasterError& errors, const Star& star, VertexId apex)
        : errors_(errors), apex_(errors.corner(apex)), size_(star.linkSize) {
      const std::int64_t p = errors.plan_.p(), q = errors.plan_.q();
      const std::uint32_t most = errors.smallSpread_;
      std::uint32_t spread = 0;
      for (int i = 0; i < size_; ++i) {
        corners_[i] = errors.corner(star.link[i]);
        const std::int32_t x = corners_[i].x - apex_.x, y = corners_[i].y - apex_.y;
        x_[i] = x * p;
        y_[i] = y * q;
        spread |= (static_cast<std::uint32_t>(x) + most) | (static_cast<std::uint32_t>(y) + most);
      }
      isSmall_ = spread < 2 * most;  // all within [-most, most), as it is a power of two
    }

    /// Whether the Delaunay triangulation of the hole depends on its own corners alone, that is, no
    /// constrained edge of the domain's border lies between them. Conservative: true where no NODATA sample
    /// is as near to the apex, in columns or rows, as the farthest corner; the raster itself is convex
    /// (docs/decisions/0017).
    bool isUnconstrained() const {
      if (!errors_.clearance_.hasVoids()) return true;
      if (errors_.reachesBeyondRims_) return false;  // there may be constrained edges that are not Delaunay
      const std::int32_t clear =
          errors_.clearance_.at(static_cast<std::uint32_t>(apex_.x), static_cast<std::uint32_t>(apex_.y));
      std::int32_t farthest = 0;
      for (int i = 0; i < size_; ++i)
        farthest = std::max({farthest, std::abs(corners_[i].x - apex_.x), std::abs(corners_[i].y - apex_.y)});
      return farthest <= clear;
    }

    /// The hole's outline as a polygon of the plan.
    LatticePlan::Polygon polygon() const {
      return {errors_.plan_, apex_, std::span(corners_.data(), static_cast<std::size_t>(size_))};
    }

    /// > 0 where corner i, corner j, apex turn left, < 0 where they turn right, 0 on one line. Exact.
    std::int64_t orientationToApex(int i, int j) const { return x_[i] * y_[j] - y_[i] * x_[j]; }

    /// The corner between i and j that sees the edge j -> i under the largest angle, among those left of it;
    /// -1 without one. Between equal angles prefersLater(first, later) decides. Exact.
    template <class PrefersLater>
    int third(int i, int j, const PrefersLater& prefersLater) const {
      return isSmall_ ? thirdIn<std::int64_t>(i, j, prefersLater) : thirdIn<Wide>(i, j, prefersLater);
    }

    /// Corner i relative to the apex: x and y in the plan's metric, z in the vertical unit.
    Vec3 fromApex(int i) const { return {double(x_[i]), double(y_[i]), corners_[i].z - apex_.z}; }
    /// Column, row and height of corner i, and of the apex.
    Vec3 position(int i) const { return positionOf(corners_[i]); }
    Vec3 apexPosition() const { return positionOf(apex_); }
    /// |z - plane| at the apex. Precondition: the triangle covers the apex.
    double apexError(int i, int j, int m) const {
      const Corner &a = corners_[i], &b = corners_[j], &c = corners_[m];
      const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y, x = apex_.x - a.x,
                   y = apex_.y - a.y, area = bx * cy - by * cx;
      return std::abs((b.z - a.z) * (x * cy - y * cx) + (c.z - a.z) * (bx * y - by * x) -
                      (apex_.z - a.z) * area) /
             area;
    }
    /// RasterError::maximum() of the triangle i, j, m.
    double maximum(int i, int j, int m, double limit) const {
      return errors_.maximum(corners_[i], corners_[j], corners_[m], limit);
    }
    double maximum(int i, int j, int m, double limit, SignedBound& bound, double& rounding) const {
      return errors_.maximum(corners_[i], corners_[j], corners_[m], limit, bound, rounding);
    }
    double maximum(int i, int j, int m, double limit, SignedBound& bound) const {
      double rounding;
      return maximum(i, j, m, limit, bound, rounding);
    }
    /// RasterError::isAbove() of the triangle i, j, m.
    bool isAbove(int i, int j, int m, double error, double rounding, double bound) const {
      return errors_.isAbove(corners_[i], corners_[j], corners_[m], error, rounding, bound);
    }
    /// Samples on an edge are covered by both triangles: no error is left for the edge.
    EdgeDifference alongEdge(int i, int j) const { return {errors_.alongEdge(corners_[i], corners_[j])}; }
    bool isAboveOnEdge(int, int, double) const { return false; }
    /// See PointError::Hole::settle(): a raster has nothing to redistribute.
    void settle(const HoleTriangulation&) const {}

   private:
    __extension__ using Wide = __int128;

    static Vec3 positionOf(const Corner& c) { return {double(c.x), double(c.y), c.z}; }

    /// Compares angles by their cotangents, dot / cross; all crosses are positive.
    template <class T, class PrefersLater>
    int thirdIn(int i, int j, const PrefersLater& prefersLater) const {
      const T ax = x_[i], ay = y_[i], bx = x_[j], by = y_[j];
      int best = -1;
      T bestDot = 1, bestCross = 0;
      for (int m = i + 1; m < j; ++m) {
        const T ux = ax - x_[m], uy = ay - y_[m], vx = bx - x_[m], vy = by - y_[m];
        const T cross = vx * uy - vy * ux;
        if (cross <= 0) continue;
        const T dot = ux * vx + uy * vy;
        const T mine = dot * bestCross, theirs = bestDot * cross;
        bool isBetter = mine < theirs;
        if (mine == theirs) isBetter = prefersLater(best, m);
        best = isBetter ? m : best;
        bestDot = isBetter ? dot : bestDot;
        bestCross = isBetter ? cross : bestCross;
      }
      return best;
    }

    const RasterError& errors_;
    Corner apex_;
    int size_;
    bool isSmall_;
    std::array<std::int64_t, kMaxHoleCorners> x_, y_;  // from the apex, on the plan: times p and q
    std::array<Corner, kMaxHoleCorners> corners_;
  };

  /// Refers to `plan` and `heights`. O(samples), parallel.
  /// @param heights  row by row, NaN for NODATA
  /// @param reachesBeyondRims  whether triangles may extend beyond the rim of the domain (a rim tolerance is
  ///        in use)
  /// @param crossingRounding  bounds the rounding error of alongEdge()
  RasterError(const LatticePlan& plan, std::span<const double> heights, bool reachesBeyondRims,
              double crossingRounding = 0)
      : RasterError(plan, heights, reachesBeyondRims, crossingRounding, HeightUnit::of(heights)) {}

  /// Prefetches the heights around a vertex that is evaluated soon.
  [[gnu::always_inline]] void prefetch(VertexId vertex) const {
    const std::size_t columns = plan_.columns(), sample = vertex.index();
    heights_.prefetch(sample);
    if (sample >= columns) heights_.prefetch(sample - columns);
    if (sample + columns < heights_.size()) heights_.prefetch(sample + columns);
  }
  /// Prefetches the heights under a star whose apex is removed soon.
  [[gnu::always_inline]] void prefetch(const Star& star) const {
    constexpr std::uint32_t kMostRows = 8;
    if (star.linkSize == 0) return;
    LatticePlan::Cell least = plan_.cell(star.link[0]), most = least;
    for (int i = 1; i < star.linkSize; ++i) {
      const LatticePlan::Cell cell = plan_.cell(star.link[i]);
      least = {std::min(least.column, cell.column), std::min(least.row, cell.row)};
      most = {std::max(most.column, cell.column), std::max(most.row, cell.row)};
    }
    std::size_t sample = std::size_t(least.row) * plan_.columns() + (least.column + most.column) / 2;
    for (std::uint32_t i = 0; i <= std::min(most.row - least.row, kMostRows); ++i, sample += plan_.columns())
      heights_.prefetch(sample);
  }

  /// The error at a sample when it is removed from the finest triangulation with the Delaunay shape; -1 where
  /// one of its six neighbours there has no data or is missing. Two of the hole's triangles are the outer
  /// halves of cells. The other two share a diagonal of the rhombus of the four nearest neighbours, whose
  /// middle is the sample: the shorter diagonal, or of two equal ones the one closer in height.
  /// @param witness  receives the corners of one of these two triangles
  double costInFinest(VertexId vertex, std::array<VertexId, 3>& witness) const {
    const std::uint32_t columns = plan_.columns(), sample = vertex.index();
    const LatticePlan::Cell cell = plan_.cell(vertex);
    if (cell.column == 0 || cell.row == 0 || cell.column + 1 == columns || cell.row + 1 == rows_) return -1;
    const double* z = &heights_.given()[sample];
    const std::ptrdiff_t down = columns;
    const double along = std::abs(z[0] - (z[-1] + z[1]) / 2),
                 across = std::abs(z[0] - (z[-down] + z[down]) / 2);
    if (std::isnan(along + across + z[-down - 1] + z[down + 1])) return -1;
    const bool isAlong = plan_.p() != plan_.q() ? plan_.p() < plan_.q() : along < across;
    const std::array neighbours = isAlong ? std::array{sample - 1, sample + 1, sample + columns}
                                          : std::array{sample - columns, sample + columns, sample + 1};
    std::ranges::transform(neighbours, witness.begin(), [](std::uint32_t v) { return VertexId(v); });
    return isAlong ? along : across;
  }

  /// A lower bound of the error at a sample when it is removed from the finest triangulation, however the
  /// hole is triangulated: the least error at the sample of any triangle of its six neighbours that covers
  /// it. -1 where one of the six has no data or is missing. A triangle with two opposite neighbours has the
  /// error of their mean; any other triangle that covers the sample has every second neighbour as a corner.
  double boundInFinest(VertexId vertex) const {
    const std::uint32_t columns = plan_.columns();
    const LatticePlan::Cell cell = plan_.cell(vertex);
    if (cell.column == 0 || cell.row == 0 || cell.column + 1 == columns || cell.row + 1 == rows_) return -1;
    const double* z = &heights_.given()[vertex.index()];
    const std::ptrdiff_t down = columns;
    const double right = z[1] - z[0], rightBelow = z[down + 1] - z[0], below = z[down] - z[0],
                 left = z[-1] - z[0], leftAbove = z[-down - 1] - z[0], above = z[-down] - z[0];
    if (std::isnan(right + rightBelow + below + left + leftAbove + above)) return -1;
    const double facing =
        std::min({std::abs(right + left), std::abs(rightBelow + leftAbove), std::abs(below + above)});
    return std::min(
        {facing / 2, std::abs(right + below + leftAbove) / 3, std::abs(rightBelow + left + above) / 3});
  }

  /// The live mesh is compacted when this part of its slots is in use. Compacting sooner costs 2 to 5 % of a
  /// build's time and does not lower the peak of memory, which lies in MtRecorder::finish().
  static constexpr double kLeastLive = 0.5;
  /// Called when the live mesh has moved its triangles. Does nothing: no data here is kept by triangle.
  void compact(const SlotMap&) {}

  /// max |z - plane| over the covered samples. Precondition: a, b, c counter-clockwise. O(samples covered +
  /// rows); for a wide triangle typically O(rows + samples / 64).
  /// @param limit  the scan stops soon after this is exceeded
  /// @return the maximum, or some value > limit
  double maximum(const Corner& a, const Corner& b, const Corner& c, double limit) const;

  /// The same; also extends `bound` by the signed differences at the covered samples, complete where the
  /// result is <= limit.
  /// @param rounding  receives a bound of the result's rounding error
  double maximum(const Corner& a, const Corner& b, const Corner& c, double limit, SignedBound& bound,
                 double& rounding) const;
  double maximum(const Corner& a, const Corner& b, const Corner& c, double limit, SignedBound& bound) const {
    double rounding;
    return maximum(a, b, c, limit, bound, rounding);
  }

  /// Whether the error of a triangle exceeds `bound`, exactly. All heights being multiples of a unit, the
  /// error is a multiple of unit / doubled area; where its rounding error is less than half of that, this is
  /// O(1). Otherwise the samples are scanned, and exact arithmetic decides those near the bound.
  /// @param error, rounding  from maximum(), not stopped by a limit
  bool isAbove(const Corner& a, const Corner& b, const Corner& c, double error, double rounding,
               double bound) const {
    const double area = double(b.x - a.x) * double(c.y - a.y) - double(b.y - a.y) * double(c.x - a.x);
    const double units = error * area * perUnit_;
    // All products are exact: a bound is a float.
    if (rounding * area < unit_ / 4 && units < 0x1p50) {
      constexpr double kShift = 0x1.8p52;  // rounds to the nearest whole number
      return (units + kShift - kShift) * unit_ > bound * area;
    }
    return isAnySampleAbove(a, b, c, bound);
  }

  /// Bounds of the signed difference between the segment a-b and the finest triangulation at the points where
  /// the segment crosses its edges. Together with the samples inside, these points contain the extremes of
  /// the difference over a triangle. O(length in samples).
  SignedBound alongEdge(const Corner& a, const Corner& b) const {
    return !reachesBeyondRims_ && EdgeCrossingTable::isShort(b.x - a.x, b.y - a.y) ? alongShortEdge(a, b)
                                                                                   : alongLongEdge(a, b);
  }

 private:
  RasterError(const LatticePlan& plan, std::span<const double> heights, bool reachesBeyondRims,
              double crossingRounding, const HeightUnit& heightUnit)
      : plan_(plan),
        heights_(heights),
        rows_(static_cast<std::uint32_t>(heights.size() / plan.columns())),
        reachesBeyondRims_(reachesBeyondRims),
        roundUp_(0.5 - 0.5 / rows_),
        unit_(heightUnit.unit),
        perUnit_(unit_ > 0 ? 1 / unit_ : 0),
        leastSmallDifference_(unit_ / 8),
        areMiddlesExact_(heightUnit.areMiddlesExact()),
        isUnitCoarse_(heightUnit.isCoarse()),
        crossingRounding_(crossingRounding),
        areCrossingsSure_(4 * crossingRounding * std::max(plan.columns(), rows_) < unit_),
        blocks_(heights, plan.columns()),
        clearance_(heights, plan.columns()),
        edgeCrossings_(plan.columns()) {
    // With f the larger of p and q, coordinate differences below 2 s f give a dot and a cross product below
    // 8 (s f)^2; the product of these two must stay below 2^63.
    const double f = std::max(plan.p(), plan.q());
    while (64 * std::pow(2.0 * smallSpread_ * f, 4) < 0x1p62) smallSpread_ *= 2;
  }

  SignedBound alongShortEdge(const Corner& a, const Corner& b) const;
  SignedBound alongUnsureEdge(const Corner& a, const Corner& b) const;
  SignedBound alongLongEdge(const Corner& a, const Corner& b) const;
  bool isSmall(const Corner& a, const Corner& b, const Corner& c, double& difference, double& rounding) const;
  template <class Visit>
  bool isAnySample(const Corner& a, const Corner& b, const Corner& c, const Visit& visit) const;
  bool isAnySampleAbove(const Corner& a, const Corner& b, const Corner& c, double bound) const;
  bool isAnySampleSigned(const Corner& a, const Corner& b, const Corner& c, int sign) const;
  template <class Height, class Differences>
  class PlaneDifferences;
  template <class Differences>
  void compare(const Corner& a, const Corner& b, const Corner& c, Differences& differences) const;
  template <class Height, class Differences>
  void compareWith(const Height* heights, const Corner& a, const Corner& b, const Corner& c,
                   Differences& differences) const;
  template <class Height, class Differences>
  void compareByBlocks(const Corner& a, const Corner& b, const Corner& c, const TriangleRows& rows,
                       PlaneDifferences<Height, Differences>& plane, Differences& differences) const;

  const LatticePlan& plan_;
  SampleHeights heights_;
  std::uint32_t rows_;
  bool reachesBeyondRims_;
  double roundUp_;               // see TriangleRows
  double unit_, perUnit_;        // all heights are multiples of the unit; 0: not known
  double leastSmallDifference_;  // no difference that isSmall() finds is smaller, but for 0
  bool areMiddlesExact_;         // HeightUnit::areMiddlesExact()
  bool isUnitCoarse_;            // HeightUnit::isCoarse()
  double crossingRounding_;      // of alongEdge()
  bool areCrossingsSure_;        // whether the sign of a difference along an edge is never lost to rounding
  HeightBlocks blocks_;
  VoidClearance clearance_;
  EdgeCrossingTable edgeCrossings_;
  const TriangleScanTable& scanTable_ = TriangleScanTable::all();
  std::uint32_t smallSpread_ = 1;  // a power of two: spreads below it keep Hole::third() in 64 bits
};

}  // namespace arete
