// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points are sorted into a grid of square buckets of about two points each, row by row; lengths are in
// units of the mean spacing ("pixels"), from the lower left of the points, so that the plan tolerance means
// the same for degrees and for metres. A band is some rows of buckets. Each triangle walks the rows of
// buckets it reaches; within a row, its extent in x over the row's strip is found by clipping its sides, and
// the points of the buckets there are decided one by one. A long thin triangle therefore visits the buckets
// along it and not those of its bounding box.
//
// Points near one line make triangles far thinner than the plan tolerance, and a neighbour's side within it
// of a point need not be anywhere near the height of the sliver that the point lies in. So which triangles
// hold a point is decided exactly, on the source coordinates, and these say how high the TIN is there,
// slivers too thin to count otherwise included; the tolerance is for points that no triangle holds. Triangles
// overlap at a point where they do so both exactly and by more than the tolerance. Of a mesh whose x and y
// are rounded there is nothing exact to be had: there the tolerance decides alone.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "terrain/measure/bands.h"
#include "terrain/measure/exact.h"
#include "terrain/measure/measure.h"
#include "terrain/measure/triangle.h"

namespace arete {

using measuring::BandTotals;
using measuring::Contact;
using measuring::Gathered;
using measuring::PlanTriangle;
using measuring::TriangleBands;

namespace {

constexpr double kBucketSide = 1.5;

/// From source coordinates to units of the mean spacing of the points.
struct PlanScale {
  Vec2 origin;
  double spacing = 1;
  double width = 0, height = 0;  ///< of the points' box, in spacings

  explicit PlanScale(const std::vector<Vec2>& positions) {
    if (positions.empty()) return;
    Vec2 low = positions.front(), high = low;
    for (const Vec2& p : positions) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const double w = high.x - low.x, h = high.y - low.y, n = static_cast<double>(positions.size());
    // The second term keeps the number of buckets linear when all points are nearly on a line.
    spacing = std::max(std::sqrt(w) * std::sqrt(h / n), std::max(w, h) / n);
    if (!(spacing > 0)) spacing = 1;
    origin = low;
    width = w / spacing;
    height = h / spacing;
  }

  Vec2 toPlan(double x, double y) const { return {(x - origin.x) / spacing, (y - origin.y) / spacing}; }
};

/// What the triangles within the tolerance of each point left there, and what those left that hold it. The
/// second is empty where nothing is exact.
struct GatheredPoints {
  Gathered near, held;

  /// Which of the two says how high the TIN is at a point.
  const Gathered& at(std::size_t point) const {
    return held.size() > 0 && held.isCovered(point) ? held : near;
  }
};

class PointMeasurement {
 public:
  PointMeasurement(const TriangleMesh& mesh, const PointHeightfield& points, const MeasureOptions& options,
                   const RunContext& context, MeasureRasters* rasters)
      : mesh_(mesh),
        points_(points),
        options_(options),
        context_(context),
        rasters_(rasters),
        scale_(points.positions),
        tolerance_(measuring::raisedTolerance(
            options, {options.planRounding.x / scale_.spacing, options.planRounding.y / scale_.spacing})),
        isExact_(options.planRounding == Vec2{}) {}

  Result<MeasureReport> run() {
    if (!(scale_.width < 1e18 && scale_.height < 1e18))
      return failure(ErrorCode::invalidData, "the points lie too far apart to be measured", points_.source);
    sortPoints();
    plan_.reserve(mesh_.positions.size());
    for (const Vec3& p : mesh_.positions) {
      plan_.push_back(scale_.toPlan(p.x, p.y));
      if (!(std::abs(plan_.back().x) < 1e100 && std::abs(plan_.back().y) < 1e100))
        return failure(ErrorCode::invalidData,
                       "the mesh has a vertex too far from the points to be measured");
    }
    constexpr std::int64_t kBands = 128;
    bucketRowsPerBand_ = (bucketRows_ + kBands - 1) / kBands;
    bands_ = measuring::sortIntoBands(mesh_, plan_, bucketRows_, kBucketSide, bucketRowsPerBand_, tolerance_,
                                      isExact_);
    if (rasters_) {
      rasters_->tinHeights.resize(points_.size());
      rasters_->errors.resize(points_.size());
    }
    std::vector<BandTotals> totals(points_.size() == 0 ? 0 : bands_.begin.size() - 1);
    const Status scanned = measuring::forEachBand(totals.size(), context_, "measuring",
                                                  [&](std::size_t band) { totals[band] = scanBand(band); });
    if (!scanned) return tl::unexpected(scanned.error());

    BandTotals all;
    for (const BandTotals& band : totals) all.add(band);
    MeasureReport report = all.finish();
    report.triangles = mesh_.triangles.size();
    report.vertices = mesh_.positions.size();
    report.degenerateTriangles = bands_.degenerate;
    report.tinAreaPixels = bands_.areaPixels;
    return report;
  }

 private:
  std::size_t bucketOf(Vec2 plan) const {
    const auto column = std::min(static_cast<std::int64_t>(plan.x / kBucketSide), bucketColumns_ - 1);
    const auto row = std::min(static_cast<std::int64_t>(plan.y / kBucketSide), bucketRows_ - 1);
    return static_cast<std::size_t>(row * bucketColumns_ + column);
  }

  void sortPoints() {
    bucketColumns_ = static_cast<std::int64_t>(scale_.width / kBucketSide) + 1;
    bucketRows_ = static_cast<std::int64_t>(scale_.height / kBucketSide) + 1;
    bucketBegin_.assign(static_cast<std::size_t>(bucketColumns_ * bucketRows_) + 1, 0);
    for (const Vec2& p : points_.positions) ++bucketBegin_[bucketOf(scale_.toPlan(p.x, p.y)) + 1];
    std::partial_sum(bucketBegin_.begin(), bucketBegin_.end(), bucketBegin_.begin());
    std::vector<std::uint64_t> next(bucketBegin_.begin(), bucketBegin_.end() - 1);
    order_.resize(points_.size());
    sorted_.resize(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Vec2 p = scale_.toPlan(points_.positions[i].x, points_.positions[i].y);
      const std::uint64_t slot = next[bucketOf(p)]++;
      order_[slot] = i;
      sorted_[slot] = {p.x, p.y, points_.heights[i]};
    }
  }

  BandTotals scanBand(std::size_t band) {
    const std::int64_t firstRow = static_cast<std::int64_t>(band) * bucketRowsPerBand_;
    const std::int64_t endRow = std::min(firstRow + bucketRowsPerBand_, bucketRows_);
    const std::uint64_t firstPoint = bucketBegin_[firstRow * bucketColumns_];
    const std::uint64_t endPoint = bucketBegin_[endRow * bucketColumns_];
    GatheredPoints gathered{Gathered(endPoint - firstPoint), Gathered(isExact_ ? endPoint - firstPoint : 0)};
    PlanTriangle triangle;
    std::size_t untilCheck = measuring::kTrianglesPerCancelCheck;
    for (const std::uint32_t id : bands_.of(band)) {
      if (--untilCheck == 0) {
        if (context_.cancelled()) return {};
        untilCheck = measuring::kTrianglesPerCancelCheck;
      }
      const bool hasArea = measuring::setTriangle(triangle, mesh_, plan_, id, tolerance_);
      scanTriangle(triangle, hasArea, id, firstRow, endRow, firstPoint, gathered);
    }
    return countBand(firstPoint, endPoint, gathered);
  }

  void scanTriangle(const PlanTriangle& t, bool hasArea, std::uint32_t id, std::int64_t firstRow,
                    std::int64_t endRow, std::uint64_t firstPoint, GatheredPoints& gathered) const {
    const auto& v = mesh_.triangles[id];
    const std::array<Vec3, 3> corners = {mesh_.positions[v[0]], mesh_.positions[v[1]], mesh_.positions[v[2]]};
    // Generous: clipping rounds, and every point met is decided by itself.
    const double margin = 4 * tolerance_;
    const auto [yLow, yHigh] = std::minmax({t.corner[0].y, t.corner[1].y, t.corner[2].y});
    const auto rowOf = [](double y) { return std::floor(y / kBucketSide); };
    const auto first = static_cast<std::int64_t>(std::max(rowOf(yLow - margin), double(firstRow)));
    const auto last = static_cast<std::int64_t>(std::min(rowOf(yHigh + margin), double(endRow - 1)));
    for (std::int64_t row = first; row <= last; ++row) {
      const double stripLow = double(row) * kBucketSide - margin,
                   stripHigh = double(row + 1) * kBucketSide + margin;
      double xLow = std::numeric_limits<double>::infinity(), xHigh = -xLow;
      const auto extend = [&](double x) {
        xLow = std::min(xLow, x);
        xHigh = std::max(xHigh, x);
      };
      for (int i = 0; i < 3; ++i) {
        const Vec2 &a = t.corner[i], &b = t.corner[(i + 1) % 3];
        if (a.y >= stripLow && a.y <= stripHigh) extend(a.x);
        for (const double y : {stripLow, stripHigh})
          if ((a.y < y) != (b.y < y)) extend(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
      }
      // A corner within the margin of the strip, none inside it: the tolerance frame alone reaches this row.
      if (!(xLow <= xHigh)) continue;
      const double low = std::max(std::floor((xLow - margin) / kBucketSide), 0.0);
      const double high = std::min(std::floor((xHigh + margin) / kBucketSide), double(bucketColumns_ - 1));
      if (!(low <= high)) continue;
      const std::uint64_t begin = bucketBegin_[row * bucketColumns_ + static_cast<std::int64_t>(low)];
      const std::uint64_t end = bucketBegin_[row * bucketColumns_ + static_cast<std::int64_t>(high) + 1];
      for (std::uint64_t slot = begin; slot < end; ++slot) {
        const Vec3& p = sorted_[slot];
        if (hasArea)
          if (const Contact c = t.contact(p.x, p.y, tolerance_); c.covers)
            gathered.near.add(slot - firstPoint, p.z, id, c.z, c.strict, c.turn);
        if (!isExact_) continue;
        if (const auto c = measuring::contactWhereHeld(corners, points_.positions[order_[slot]]))
          gathered.held.add(slot - firstPoint, p.z, id, c->z, c->strict, c->turn);
      }
    }
  }

  BandTotals countBand(std::uint64_t firstPoint, std::uint64_t endPoint, const GatheredPoints& both) {
    BandTotals totals;
    MeasureReport& counts = totals.counts;
    for (std::uint64_t slot = firstPoint; slot < endPoint; ++slot) {
      const std::uint64_t point = order_[slot];
      const std::size_t here = slot - firstPoint;
      const Gathered& gathered = both.at(here);
      if (rasters_) {
        rasters_->tinHeights[point] = gathered.z(here);
        rasters_->errors[point] = std::numeric_limits<double>::quiet_NaN();
      }
      if (!options_.mask.empty() && options_.mask[point] == 0) continue;
      ++counts.samples;
      ++counts.valid;
      // Near a sliver a triangle beside it may seem to fill its turn; and coordinates that were rounded may
      // make two neighbours hold a place between them.
      counts.doublyCovered += both.near.isDoublyCovered(here) && gathered.isDoublyCovered(here);
      counts.overlapped += both.near.isOverlapped(here) && gathered.isOverlapped(here);
      if (!gathered.isCovered(here)) {
        ++counts.uncovered;
        continue;
      }
      const Vec2& at = points_.positions[point];
      totals.addMeasured(
          {point, 0, 0, at.x, at.y, points_.heights[point], gathered.z(here), gathered.triangle(here)});
      if (rasters_) rasters_->errors[point] = gathered.z(here) - points_.heights[point];
    }
    return totals;
  }

  const TriangleMesh& mesh_;
  const PointHeightfield& points_;
  const MeasureOptions& options_;
  const RunContext& context_;
  MeasureRasters* rasters_;
  PlanScale scale_;
  double tolerance_;
  bool isExact_;  // the mesh says to the bit where its vertices are
  std::int64_t bucketColumns_ = 1, bucketRows_ = 1, bucketRowsPerBand_ = 1;
  std::vector<std::uint64_t> bucketBegin_;
  std::vector<std::uint64_t> order_;  // slot -> point
  std::vector<Vec3> sorted_;          // plan position and height by slot
  std::vector<Vec2> plan_;
  TriangleBands bands_;
};

}  // namespace

Result<MeasureReport> measure(const TriangleMesh& mesh, const PointHeightfield& points,
                              const MeasureOptions& options, const RunContext& context,
                              MeasureRasters* rasters) {
  if (const Status ok = points.validate(); !ok) return tl::unexpected(ok.error());
  if (const Status ok = measuring::checkInputs(mesh, points.size(), options); !ok)
    return tl::unexpected(ok.error());
  return PointMeasurement(mesh, points, options, context, rasters).run();
}

}  // namespace arete
