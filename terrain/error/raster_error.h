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
#include "terrain/error/sample_heights.h"
#include "terrain/error/signed_bound.h"
#include "terrain/error/triangle_scan_table.h"
#include "terrain/error/void_clearance.h"
#include "terrain/triangulation/lattice_plan.h"

namespace arete {

class TriangleRows;

/// Vertical error of triangles over a raster, exactly: every sample a triangle covers, its edges included, is
/// compared with the triangle's plane. Triangles are planar in (column, row). NODATA inside a triangle is
/// passed over.
class RasterError {
 public:
  /// A sample by column and row, with its height.
  struct Corner {
    std::int32_t x, y;
    double z;
  };
  Corner corner(std::uint32_t sample) const {
    const LatticePlan::Cell cell = plan_.cell(sample);
    return {static_cast<std::int32_t>(cell.column), static_cast<std::int32_t>(cell.row), heights_[sample]};
  }

  /// The hole that a vertex leaves: the geometry and the errors of triangles named by corners of its link.
  class Hole {
   public:
    Hole(const RasterError& errors, const Star& star, std::uint32_t apex)
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

    /// Whether nothing but its own corners decides how the hole of a Delaunay triangulation is filled: no
    /// border of the domain comes between them. So it is where no void is as near to the apex as the farthest
    /// corner, in columns or rows: the raster itself is convex (docs/decisions/0017).
    bool isUnconstrained() const {
      if (!errors_.clearance_.hasVoids()) return true;
      if (errors_.reachesBeyondRims_) return false;  // edges may be held that are not Delaunay
      const std::int32_t clear =
          errors_.clearance_.at(static_cast<std::uint32_t>(apex_.x), static_cast<std::uint32_t>(apex_.y));
      std::int32_t farthest = 0;
      for (int i = 0; i < size_; ++i)
        farthest = std::max({farthest, std::abs(corners_[i].x - apex_.x), std::abs(corners_[i].y - apex_.y)});
      return farthest <= clear;
    }

    /// For the slower queries.
    LatticePlan::Polygon polygon() const {
      return {errors_.plan_, apex_, std::span(corners_.data(), static_cast<std::size_t>(size_))};
    }

    /// Of whether corners i, j and the apex turn left (> 0), right, or not at all; exact.
    std::int64_t orientationToApex(int i, int j) const { return x_[i] * y_[j] - y_[i] * x_[j]; }

    /// The corner between i and j with the largest angle over the edge j -> i, among those that turn left, or
    /// -1. Of two with the same angle `prefersLater(first, later)` decides. Exact.
    template <class PrefersLater>
    int third(int i, int j, const PrefersLater& prefersLater) const {
      return isSmall_ ? thirdIn<std::int64_t>(i, j, prefersLater) : thirdIn<Wide>(i, j, prefersLater);
    }

    /// Where corner i lies from the apex, in the metric of the plan, and by how much it is higher.
    Vec3 fromApex(int i) const { return {double(x_[i]), double(y_[i]), corners_[i].z - apex_.z}; }
    /// Corner i, and the apex, on the plan and with their heights.
    Vec3 position(int i) const { return positionOf(corners_[i]); }
    Vec3 apexPosition() const { return positionOf(apex_); }
    /// |z - plane| at the apex, of a triangle over it.
    double apexError(int i, int j, int m) const {
      const Corner &a = corners_[i], &b = corners_[j], &c = corners_[m];
      const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y, x = apex_.x - a.x,
                   y = apex_.y - a.y, area = bx * cy - by * cx;
      return std::abs((b.z - a.z) * (x * cy - y * cx) + (c.z - a.z) * (bx * y - by * x) -
                      (apex_.z - a.z) * area) /
             area;
    }
    double maximum(int i, int j, int m, double limit) const {
      return errors_.maximum(corners_[i], corners_[j], corners_[m], limit);
    }
    double maximum(int i, int j, int m, double limit, SignedBound& bound) const {
      return errors_.maximum(corners_[i], corners_[j], corners_[m], limit, bound);
    }
    SignedBound alongEdge(int i, int j) const { return errors_.alongEdge(corners_[i], corners_[j]); }
    void settle(const HoleTriangulation&) const {}

   private:
    __extension__ using Wide = __int128;

    static Vec3 positionOf(const Corner& c) { return {double(c.x), double(c.y), c.z}; }

    /// The larger angle has the smaller cotangent, dot / cross, and all crosses are positive.
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

  /// `reachesBeyondRims`: triangles may reach beyond the rim of the domain (a rim tolerance is in use).
  RasterError(const LatticePlan& plan, std::span<const double> heights, bool reachesBeyondRims)
      : plan_(plan),
        heights_(heights),
        rows_(static_cast<std::uint32_t>(heights.size() / plan.columns())),
        reachesBeyondRims_(reachesBeyondRims),
        roundUp_(0.5 - 0.5 / rows_),
        blocks_(heights, plan.columns()),
        clearance_(heights, plan.columns()),
        shortEdges_(plan.columns()) {
    // Differences below 2 s f, f the larger of p and q, make a dot and a cross below 8 (s f)^2: the product
    // of the two must stay below 2^63.
    const double f = std::max(plan.p(), plan.q());
    while (64 * std::pow(2.0 * smallSpread_ * f, 4) < 0x1p62) smallSpread_ *= 2;
  }

  double height(std::uint32_t sample) const { return heights_[sample]; }
  /// Asks for the heights around a vertex that is soon to be evaluated.
  [[gnu::always_inline]] void prefetch(std::uint32_t sample) const {
    const std::size_t columns = plan_.columns();
    heights_.prefetch(sample);
    if (sample >= columns) heights_.prefetch(sample - columns);
    if (sample + columns < heights_.size()) heights_.prefetch(sample + columns);
  }
  /// Asks for the heights under a star whose vertex is soon to be removed.
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

  /// What it costs to remove a sample from the finest triangulation, where its six neighbours there are
  /// valid; -1 elsewhere. Two of the hole's triangles are the outer halves of cells; the other two share one
  /// diagonal of the rhombus of the four nearest neighbours, whose middle is the sample: the shorter one, or
  /// of two alike the one that passes closer. `witness`: the corners of one of these.
  double costInFinest(std::uint32_t sample, std::array<std::uint32_t, 3>& witness) const {
    const std::uint32_t columns = plan_.columns();
    const LatticePlan::Cell cell = plan_.cell(sample);
    if (cell.column == 0 || cell.row == 0 || cell.column + 1 == columns || cell.row + 1 == rows_) return -1;
    const double* z = &heights_.given()[sample];
    const std::ptrdiff_t down = columns;
    const double along = std::abs(z[0] - (z[-1] + z[1]) / 2),
                 across = std::abs(z[0] - (z[-down] + z[down]) / 2);
    if (std::isnan(along + across + z[-down - 1] + z[down + 1])) return -1;
    const bool isAlong = plan_.p() != plan_.q() ? plan_.p() < plan_.q() : along < across;
    witness = isAlong ? std::array{sample - 1, sample + 1, sample + columns}
                      : std::array{sample - columns, sample + columns, sample + 1};
    return isAlong ? along : across;
  }

  /// A bound from below of what it costs to remove a sample from the finest triangulation, whatever fills the
  /// hole: the least error at the sample of the triangles of its neighbours that cover it. -1 where one of
  /// the six is not valid. A triangle with two neighbours that face each other errs as the middle of the two;
  /// else it has every other one.
  double boundInFinest(std::uint32_t sample) const {
    const std::uint32_t columns = plan_.columns();
    const LatticePlan::Cell cell = plan_.cell(sample);
    if (cell.column == 0 || cell.row == 0 || cell.column + 1 == columns || cell.row + 1 == rows_) return -1;
    const double* z = &heights_.given()[sample];
    const std::ptrdiff_t down = columns;
    const double right = z[1] - z[0], rightBelow = z[down + 1] - z[0], below = z[down] - z[0],
                 left = z[-1] - z[0], leftAbove = z[-down - 1] - z[0], above = z[-down] - z[0];
    if (std::isnan(right + rightBelow + below + left + leftAbove + above)) return -1;
    const double facing =
        std::min({std::abs(right + left), std::abs(rightBelow + leftAbove), std::abs(below + above)});
    return std::min(
        {facing / 2, std::abs(right + below + leftAbove) / 3, std::abs(rightBelow + left + above) / 3});
  }

  /// When so many of the live mesh's slots are left it is to be made smaller: 2 to 5 % of a build's time
  /// would be its price sooner, for memory that is not missing at the peak, which is MtRecorder::finish()'s.
  static constexpr double kLeastLive = 0.5;
  /// The live mesh has moved its triangles: nothing here hangs on them.
  void compact(const SlotMap&) {}

  /// max |z - plane| over the samples covered; gives up soon beyond the limit and returns a value > limit.
  /// Precondition: a, b, c counter-clockwise. O(samples covered + rows); of a wide triangle most often
  /// O(rows + samples / 64).
  double maximum(const Corner& a, const Corner& b, const Corner& c, double limit) const;

  /// The same, and the signed difference over the covered samples, all of them within the limit.
  double maximum(const Corner& a, const Corner& b, const Corner& c, double limit, SignedBound& bound) const;

  /// Signed difference between the segment a-b and the finest triangulation where the segment crosses its
  /// edges: with the samples inside, these hold the extremes of the difference over a triangle. O(length in
  /// samples).
  SignedBound alongEdge(const Corner& a, const Corner& b) const {
    return !reachesBeyondRims_ && EdgeCrossingTable::isShort(b.x - a.x, b.y - a.y) ? alongShortEdge(a, b)
                                                                                   : alongLongEdge(a, b);
  }

 private:
  SignedBound alongShortEdge(const Corner& a, const Corner& b) const;
  SignedBound alongLongEdge(const Corner& a, const Corner& b) const;
  bool isSmall(const Corner& a, const Corner& b, const Corner& c, double& difference) const;
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
  double roundUp_;  // to the next whole number, as nearest number to the sum: of fractions of a rise in rows
  HeightBlocks blocks_;
  VoidClearance clearance_;
  EdgeCrossingTable shortEdges_;
  const TriangleScanTable& small_ = TriangleScanTable::all();
  std::uint32_t smallSpread_ = 1;  // a power of two: spreads below it keep Hole::third() in 64 bits
};

}  // namespace arete
