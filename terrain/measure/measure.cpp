// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices are transformed from source to grid coordinates once. A vertex within the plan tolerance of a
// sample is moved onto it. This removes the rounding of large coordinates (a UTM northing keeps 1e-9 m), and
// the arithmetic is then exact in integers for every TIN whose vertices are samples.
//
// Then each band of rows scans its triangles row by row. Where a row crosses a triangle, each of the three
// sides bounds the row from the left or from the right. The sides moved outwards by twice the tolerance give
// an interval that contains every covered sample; the sides moved inwards by as much give an interval whose
// samples are all strictly inside. The second needs no test per sample; the few samples between the two are
// decided one by one (PlanTriangle::contact). Rounding errors in the interval's ends are far below the
// tolerance, so no sample on an edge is ever lost.
//
// When all triangles of a band are scanned, its samples are counted.
#include "terrain/measure/measure.h"

#include "engine/base/caught_failure.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "terrain/measure/bands.h"
#include "terrain/measure/triangle.h"

namespace arete {

using measuring::BandTotals;
using measuring::Contact;
using measuring::Gathered;
using measuring::PlanTriangle;
using measuring::TriangleBands;

namespace {

class RasterMeasurement {
 public:
  RasterMeasurement(const measuring::Inputs& in, const RasterHeightfield& dem)
      : in_(in),
        dem_(dem),
        recorder_(in, dem.size()),
        tolerance_(planTolerancePixels(in.options, dem.georeference)) {}

  Result<MeasureReport> run() {
    ARETE_CHECK(toGrid());
    constexpr std::int64_t kSamplesPerBand = 1 << 17;
    rowsPerBand_ = std::clamp<std::int64_t>(kSamplesPerBand / std::max(dem_.columns, 1u), 8, 1024);
    bands_ = measuring::sortIntoBands(in_.mesh, grid_, dem_.rows, 1.0, rowsPerBand_, tolerance_);
    return measuring::measureBands(in_, bands_, [&](std::size_t band) { return scanBand(band); });
  }

 private:
  Status toGrid() {
    grid_.resize(in_.mesh.positions.size());
    std::atomic<bool> finite = true;
    withThreads(in_.context, [&] {
      parallelFor(IndexRange<std::size_t>(0, grid_.size(), 65536), [&](const auto& range) {
        for (std::size_t v = range.begin(); v != range.end(); ++v) {
          Vec2 p = dem_.georeference.toGrid(in_.mesh.positions[v].x, in_.mesh.positions[v].y);
          const Vec2 sample = {std::nearbyint(p.x), std::nearbyint(p.y)};
          if (std::abs(p.x - sample.x) <= tolerance_ && std::abs(p.y - sample.y) <= tolerance_) p = sample;
          // Beyond this the square of a length would overflow; no raster is that large.
          if (!(std::abs(p.x) < 1e100 && std::abs(p.y) < 1e100)) finite = false;
          grid_[v] = p;
        }
      });
    });
    if (!finite)
      return failure(ErrorCode::invalidData, "the mesh has a vertex too far from the raster to be measured");
    return {};
  }

  BandTotals scanBand(std::size_t band) {
    const std::int64_t firstRow = static_cast<std::int64_t>(band) * rowsPerBand_;
    const std::int64_t endRow = std::min<std::int64_t>(firstRow + rowsPerBand_, dem_.rows);
    Gathered gathered(static_cast<std::size_t>(endRow - firstRow) * dem_.columns);
    const bool isWhole = measuring::forTrianglesOf(band, bands_, in_, grid_, tolerance_,
                                                   [&](const PlanTriangle& triangle, std::uint32_t id, bool) {
                                                     scanTriangle(triangle, id, firstRow, endRow, gathered);
                                                   });
    return isWhole ? countBand(firstRow, endRow, gathered) : BandTotals{};
  }

  /// The part of row y inside of all three sides, each moved outwards by `outwards` pixels. Empty: low >
  /// high.
  struct Interval {
    double low, high;
  };
  static Interval rowInterval(const PlanTriangle& t, const std::array<double, 3>& inverseSlope, double y,
                              double outwards) {
    Interval interval{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (int i = 0; i < 3; ++i) {
      const Vec2& from = t.corner[(i + 1) % 3];
      const double reach = t.side[i].x * (y - from.y) + outwards * t.length[i];
      if (t.side[i].y > 0)
        interval.high = std::min(interval.high, from.x + reach * inverseSlope[i]);
      else if (t.side[i].y < 0)
        interval.low = std::max(interval.low, from.x + reach * inverseSlope[i]);
      else if (reach < 0)
        return {1, 0};
    }
    return interval;
  }

  void scanTriangle(const PlanTriangle& t, std::uint32_t id, std::int64_t firstRow, std::int64_t endRow,
                    Gathered& gathered) const {
    const double margin = 2 * tolerance_;
    const auto [yLow, yHigh] = std::minmax({t.corner[0].y, t.corner[1].y, t.corner[2].y});
    const auto [xLow, xHigh] = std::minmax({t.corner[0].x, t.corner[1].x, t.corner[2].x});
    const double boxLow = std::max(xLow - margin, 0.0),
                 boxHigh = std::min(xHigh + margin, dem_.columns - 1.0);
    if (boxLow > boxHigh) return;
    const auto first = static_cast<std::int64_t>(std::max(std::ceil(yLow - margin), double(firstRow)));
    const auto last = static_cast<std::int64_t>(std::min(std::floor(yHigh + margin), double(endRow - 1)));
    const std::array<double, 3> inverseSlope = {1 / t.side[0].y, 1 / t.side[1].y, 1 / t.side[2].y};

    for (std::int64_t row = first; row <= last; ++row) {
      const auto y = static_cast<double>(row);
      const Interval outer = rowInterval(t, inverseSlope, y, margin);
      const Interval inner = rowInterval(t, inverseSlope, y, -margin);
      const double low = std::ceil(std::max(outer.low, boxLow)),
                   high = std::floor(std::min(outer.high, boxHigh));
      if (!(low <= high)) continue;
      const auto begin = static_cast<std::int64_t>(low), end = static_cast<std::int64_t>(high) + 1;
      // With an empty strict part both of its ends are `end`: all samples are decided one by one.
      std::int64_t strictBegin = end, strictEnd = end;
      const double strictLow = std::ceil(std::max(inner.low, low)),
                   strictHigh = std::floor(std::min(inner.high, high));
      if (strictLow <= strictHigh) {
        strictBegin = static_cast<std::int64_t>(strictLow);
        strictEnd = static_cast<std::int64_t>(strictHigh) + 1;
      }
      const double* heights = dem_.heights.data() + static_cast<std::size_t>(row) * dem_.columns;
      const std::size_t base = static_cast<std::size_t>(row - firstRow) * dem_.columns;

      const auto decide = [&](std::int64_t column) {
        const Contact c = t.contact(static_cast<double>(column), y, tolerance_);
        if (c.covers) gathered.add(base + column, heights[column], id, c.z, c.strict, c.turn);
      };
      for (std::int64_t column = begin; column < strictBegin; ++column) decide(column);
      if (strictBegin < strictEnd) {
        const double rise1 = t.side[1].x * (y - t.corner[2].y), rise2 = t.side[2].x * (y - t.corner[0].y);
        for (std::int64_t column = strictBegin; column < strictEnd; ++column) {
          const auto x = static_cast<double>(column);
          const double w1 = rise1 - t.side[1].y * (x - t.corner[2].x);
          const double w2 = rise2 - t.side[2].y * (x - t.corner[0].x);
          gathered.add(base + column, heights[column], id, t.heightFromWeights(w1, w2), true,
                       measuring::kFullTurn);
        }
      }
      for (std::int64_t column = strictEnd; column < end; ++column) decide(column);
    }
  }

  /// Valid corners of the cell whose upper-left sample is (column, row); 0 outside the raster.
  int validCorners(std::int64_t column, std::int64_t row) const {
    if (column < 0 || row < 0 || column + 1 >= dem_.columns || row + 1 >= dem_.rows) return 0;
    const double* upper = dem_.heights.data() + static_cast<std::size_t>(row) * dem_.columns + column;
    const double* lower = upper + dem_.columns;
    return !std::isnan(upper[0]) + !std::isnan(upper[1]) + !std::isnan(lower[0]) + !std::isnan(lower[1]);
  }

  bool isIsolated(std::int64_t column, std::int64_t row) const {
    return validCorners(column - 1, row - 1) < 3 && validCorners(column, row - 1) < 3 &&
           validCorners(column - 1, row) < 3 && validCorners(column, row) < 3;
  }

  /// The first column again, which is counted once; where it is not covered it is missed like any other.
  bool isRepeated(std::int64_t column) const {
    return dem_.georeference.repeatsFirstColumn && column + 1 == dem_.columns;
  }

  BandTotals countBand(std::int64_t firstRow, std::int64_t endRow, const Gathered& gathered) {
    BandTotals totals;
    MeasureReport& counts = totals.counts;
    for (std::int64_t row = firstRow; row < endRow; ++row) {
      for (std::int64_t column = 0; column < dem_.columns; ++column) {
        const std::size_t sample = static_cast<std::size_t>(row) * dem_.columns + column;
        const std::size_t here = sample - static_cast<std::size_t>(firstRow) * dem_.columns;
        const bool isCounted = recorder_.begin(sample, gathered.z(here));
        if (const int corners = validCorners(column, row); corners >= 3)
          counts.domainAreaPixels += corners == 4 ? 1 : 0.5;
        if (!isCounted) continue;
        const double height = dem_.heights[sample];
        const auto measured = [&] {
          const Vec2 at = dem_.georeference.toSource(double(column), double(row));
          return MeasuredSample{sample, std::uint32_t(column), std::uint32_t(row),     at.x, at.y,
                                height, gathered.z(here),      gathered.triangle(here)};
        };
        const Vec2 plan{double(column), double(row)};
        const auto planOf = [&](std::uint32_t v) { return grid_[v]; };
        if (isRepeated(column) && (std::isnan(height) || isIsolated(column, row))) continue;
        if (isRepeated(column) && gathered.isCovered(here)) {
          recorder_.addRepeated(measured(), plan, planOf, totals);
          continue;
        }

        ++counts.samples;
        counts.doublyCovered += gathered.isDoublyCovered(here);
        counts.overlapped += gathered.isOverlapped(here);
        if (std::isnan(height)) {
          counts.nodataCovered += gathered.isInterior(here);
          continue;
        }
        ++counts.valid;
        if (isIsolated(column, row)) {
          ++counts.isolated;
        } else if (!gathered.isCovered(here)) {
          ++counts.uncovered;
        } else {
          recorder_.add(measured(), plan, planOf, totals);
        }
      }
    }
    return totals;
  }

  const measuring::Inputs& in_;
  const RasterHeightfield& dem_;
  measuring::SampleRecorder recorder_;
  double tolerance_;
  std::int64_t rowsPerBand_ = 1;
  std::vector<Vec2> grid_;
  TriangleBands bands_;
};

}  // namespace

Result<MeasureReport> measure(const TriangleMesh& mesh, const RasterHeightfield& dem,
                              const MeasureOptions& options, const RunContext& context,
                              MeasureRasters* rasters) try {
  const measuring::Inputs in{mesh, options, context, rasters};
  ARETE_CHECK(measuring::checkInputs(in, dem.validate(), dem.size()));
  return RasterMeasurement(in, dem).run();
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
