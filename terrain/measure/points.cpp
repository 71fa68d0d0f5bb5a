// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points are sorted into a grid of square buckets of about two points each, row by row. Lengths are in
// units of the mean spacing ("pixels"), from the lower left of the points, so that the plan tolerance means
// the same for degrees and for metres. A band is a run of rows of buckets. Each triangle is clipped to the
// rows of buckets that it reaches, and the points of the buckets over its extent in x there are tested one by
// one. A long thin triangle therefore visits the buckets along it and not those of its bounding box.
//
// Points near one line make triangles far thinner than the plan tolerance, and a neighbour that is within the
// tolerance of a point may be nowhere near the height of the sliver that holds the point. So which triangles
// hold a point is decided exactly, on the source coordinates, and they give the TIN's height there,
// degenerate ones included; the tolerance applies to points that no triangle holds. Triangles overlap at a
// point where they do so both exactly and by more than the tolerance. If the mesh's x and y are rounded,
// nothing exact can be said, and the tolerance alone decides.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/base/caught_failure.h"
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

/// What the triangles within the tolerance of each point left there (`near`), and what those that hold the
/// point exactly left (`held`; empty where the mesh's coordinates are rounded).
struct GatheredPoints {
  Gathered near, held;

  /// The one that gives the TIN's height at a point.
  const Gathered& at(std::size_t point) const {
    return held.size() > 0 && held.isCovered(point) ? held : near;
  }
};

class PointMeasurement {
 public:
  PointMeasurement(const measuring::Inputs& in, const PointHeightfield& points)
      : in_(in),
        points_(points),
        recorder_(in, points.size()),
        scale_(points.positions),
        tolerance_(measuring::raisedTolerance(in.options, {in.options.planRounding.x / scale_.spacing,
                                                           in.options.planRounding.y / scale_.spacing})),
        isExact_(in.options.planRounding == Vec2{}) {}

  Result<MeasureReport> run() {
    // Rows and columns of buckets have to fit 64-bit integers.
    if (!(scale_.width < 1e18 && scale_.height < 1e18))
      return failure(ErrorCode::invalidData, "the points lie too far apart to be measured", points_.source);
    sortPoints();
    plan_.reserve(in_.mesh.positions.size());
    for (const Vec3& p : in_.mesh.positions) {
      plan_.push_back(scale_.toPlan(p.x, p.y));
      if (!(std::abs(plan_.back().x) < 1e100 && std::abs(plan_.back().y) < 1e100))
        return failure(ErrorCode::invalidData,
                       "the mesh has a vertex too far from the points to be measured");
    }
    constexpr std::int64_t kBands = 128;
    bucketRowsPerBand_ = (bucketRows_ + kBands - 1) / kBands;
    bands_ = measuring::sortIntoBands(in_.mesh, plan_, bucketRows_, kBucketSide, bucketRowsPerBand_,
                                      tolerance_, isExact_);
    return measuring::measureBands(in_, bands_, [&](std::size_t band) { return scanBand(band); });
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
    // A counting sort keeps the points of a bucket in their order, so that results never vary.
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
    // The points of a band are one range of the sorted points, so bands share no output.
    const std::int64_t firstRow = static_cast<std::int64_t>(band) * bucketRowsPerBand_;
    const std::int64_t endRow = std::min(firstRow + bucketRowsPerBand_, bucketRows_);
    const std::uint64_t firstPoint = bucketBegin_[firstRow * bucketColumns_];
    const std::uint64_t endPoint = bucketBegin_[endRow * bucketColumns_];
    GatheredPoints gathered{Gathered(endPoint - firstPoint), Gathered(isExact_ ? endPoint - firstPoint : 0)};
    const bool isWhole = measuring::forTrianglesOf(
        band, bands_, in_, plan_, tolerance_,
        [&](const PlanTriangle& triangle, std::uint32_t id, bool hasArea) {
          scanTriangle(triangle, hasArea, id, firstRow, endRow, firstPoint, gathered);
        });
    return isWhole ? countBand(firstPoint, endPoint, gathered) : BandTotals{};
  }

  void scanTriangle(const PlanTriangle& t, bool hasArea, std::uint32_t id, std::int64_t firstRow,
                    std::int64_t endRow, std::uint64_t firstPoint, GatheredPoints& gathered) const {
    const auto& v = in_.mesh.triangles[id];
    const auto& p = in_.mesh.positions;
    const std::array<Vec3, 3> corners = {p[v[0]], p[v[1]], p[v[2]]};
    // Generous, since clipping rounds; every point visited is tested by itself.
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
        const Vec3& point = sorted_[slot];
        if (hasArea)
          if (const Contact c = t.contact(point.x, point.y, tolerance_); c.covers)
            gathered.near.add(slot - firstPoint, point.z, id, c.z, c.strict, c.turn);
        if (!isExact_) continue;
        if (const auto c = measuring::contactWhereHeld(corners, points_.positions[order_[slot]]))
          gathered.held.add(slot - firstPoint, point.z, id, c->z, c->strict, c->turn);
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
      if (!recorder_.begin(point, gathered.z(here))) continue;
      ++counts.samples;
      ++counts.valid;
      // Both must agree: near a sliver, a triangle beside it may seem to fill part of its turn; and with
      // rounded coordinates two neighbours may hold a point between them.
      counts.doublyCovered += both.near.isDoublyCovered(here) && gathered.isDoublyCovered(here);
      counts.overlapped += both.near.isOverlapped(here) && gathered.isOverlapped(here);
      if (!gathered.isCovered(here)) {
        ++counts.uncovered;
        continue;
      }
      const Vec2& at = points_.positions[point];
      recorder_.add(
          {point, 0, 0, at.x, at.y, points_.heights[point], gathered.z(here), gathered.triangle(here)}, at,
          [&](std::uint32_t v) {
            return Vec2{in_.mesh.positions[v].x, in_.mesh.positions[v].y};
          },
          totals);
    }
    return totals;
  }

  const measuring::Inputs& in_;
  const PointHeightfield& points_;
  measuring::SampleRecorder recorder_;
  PlanScale scale_;
  double tolerance_;
  bool isExact_;  // the mesh's x and y are not rounded
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
                              MeasureRasters* rasters) try {
  const measuring::Inputs in{mesh, options, context, rasters};
  ARETE_CHECK(measuring::checkInputs(in, points.validate(), points.size()));
  return PointMeasurement(in, points).run();
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
