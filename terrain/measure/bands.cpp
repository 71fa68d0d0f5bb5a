// SPDX-License-Identifier: GPL-3.0-or-later
//
// The plan is divided into bands of whole rows, by the size of the raster and never by the number of threads.
// A counting sort lists the triangles of each band in the mesh's order. Each band is then one task that
// shares no output with another, and the sums of the bands are added in the order of the bands. So the report
// is the same to the last bit for any number of threads.
#include "terrain/measure/bands.h"

#include "engine/parallel/each_task.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "terrain/measure/exact.h"

namespace arete::measuring {

namespace {

/// The larger of two numbers, and NaN as soon as one of them is: a promise must not hold by what cannot be
/// compared.
double largerOrNan(double a, double b) {
  return std::isnan(a) || std::isnan(b) ? std::numeric_limits<double>::quiet_NaN() : std::max(a, b);
}

constexpr double kForgivenUlps = 4;

/// The first and the last band that a triangle reaches; last < first where it reaches none.
struct BandRange {
  std::int64_t first = 0, last = -1;
};

}  // namespace

Status checkInputs(const Inputs& in, const Status& heightfield, std::size_t samples) {
  if (!heightfield) return heightfield;
  ARETE_CHECK(in.mesh.validate());
  const std::size_t triangles = in.mesh.triangles.size(), values = in.options.mask.size();
  const double tolerance = in.options.planTolerancePixels;
  if (triangles >= std::numeric_limits<std::uint32_t>::max())
    return failure(ErrorCode::unsupported,
                   fmt::format("{} triangles are more than can be measured", triangles));
  if (values != 0 && values != samples)
    return failure(ErrorCode::usage, fmt::format("the mask has {} values for {} samples", values, samples),
                   "mask");
  if (!(tolerance > 0 && tolerance < 0.25))
    return failure(ErrorCode::usage,
                   fmt::format("the plan tolerance must lie between 0 and 0.25 pixels, not {}", tolerance),
                   "planTolerancePixels");
  return {};
}

double raisedTolerance(const MeasureOptions& options, Vec2 roundingPixels) {
  // Rounded coordinates may be further off than the tolerance, which then grows with them, within a limit.
  const double rounding = 2 * std::max(std::abs(roundingPixels.x), std::abs(roundingPixels.y));
  if (!(rounding > options.planTolerancePixels)) return options.planTolerancePixels;
  return std::max(options.planTolerancePixels, std::min(rounding, kMostPlanTolerance));
}

TriangleBands sortIntoBands(const TriangleMesh& mesh, std::span<const Vec2> plan, std::int64_t rows,
                            double rowHeight, std::int64_t rowsPerBand, double tolerance, bool keepsThin) {
  const std::int64_t bands = (rows + rowsPerBand - 1) / rowsPerBand;
  TriangleBands result;
  if (bands <= 0) {
    result.begin = {0};
    return result;
  }
  result.begin.assign(static_cast<std::size_t>(bands) + 1, 0);

  const auto bandsOf = [&](std::uint32_t t) {
    const auto& v = mesh.triangles[t];
    const auto [low, high] = std::minmax({plan[v[0]].y, plan[v[1]].y, plan[v[2]].y});
    // Twice the tolerance on either side is on the safe side for every sample that the triangle may cover.
    const double first = std::floor((low - 2 * tolerance) / rowHeight);
    const double last = std::floor((high + 2 * tolerance) / rowHeight);
    if (last < 0 || first >= static_cast<double>(rows)) return BandRange{};
    return BandRange{static_cast<std::int64_t>(std::max(first, 0.0)) / rowsPerBand,
                     static_cast<std::int64_t>(std::min(last, static_cast<double>(rows - 1))) / rowsPerBand};
  };

  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  std::vector<bool> isLeftOut(count);
  PlanTriangle triangle;
  // The first pass counts the triangles of each band, the second lists them.
  for (std::uint32_t t = 0; t < count; ++t) {
    const bool hasArea = setTriangle(triangle, mesh, plan, t, tolerance);
    result.areaPixels += triangle.area2 / 2;
    result.degenerate += !hasArea;
    isLeftOut[t] = !hasArea && !keepsThin;
    if (isLeftOut[t]) continue;
    const BandRange range = bandsOf(t);
    for (std::int64_t b = range.first; b <= range.last; ++b) ++result.begin[b + 1];
  }
  for (std::int64_t b = 0; b < bands; ++b) result.begin[b + 1] += result.begin[b];

  result.triangles.resize(result.begin.back());
  std::vector<std::uint64_t> next(result.begin.begin(), result.begin.end() - 1);
  for (std::uint32_t t = 0; t < count; ++t) {
    if (isLeftOut[t]) continue;
    const BandRange range = bandsOf(t);
    for (std::int64_t b = range.first; b <= range.last; ++b) result.triangles[next[b]++] = t;
  }
  return result;
}

void BandTotals::addMeasured(const MeasuredSample& sample) {
  const double error = sample.error();
  sum += error;
  sumAbs += std::abs(error);
  sumSquares += error * error;
  ++counts.covered;
  addLargest(sample);
}

void BandTotals::addLargest(const MeasuredSample& sample) {
  const double error = sample.error();
  // Points are scanned by buckets, not in sample order: among equal errors the first sample is kept.
  const bool earlier =
      counts.worst && std::abs(error) == counts.maxAbsError && sample.sample < counts.worst->sample;
  if (!counts.worst || earlier || std::abs(error) > counts.maxAbsError) {
    counts.maxAbsError = std::abs(error);
    counts.worst = sample;
  }
}

void BandTotals::addBeyondRounding(const MeasuredSample& sample, const std::array<Vec3, 3>& corner, Vec2 at) {
  const double error =
      std::abs(errorWhereHeld(corner, {at.x, at.y, sample.demHeight}).value_or(sample.error()));
  double height = std::abs(sample.demHeight);
  for (const Vec3& c : corner) height = std::max(height, std::abs(c.z));
  const double ulp = std::nextafter(height, std::numeric_limits<double>::infinity()) - height;
  const double beyond = error - kForgivenUlps * ulp;
  counts.errorBeyondRounding = largerOrNan(counts.errorBeyondRounding, beyond);
}

void BandTotals::add(const BandTotals& later) {
  const MeasureReport& c = later.counts;
  counts.samples += c.samples;
  counts.valid += c.valid;
  counts.covered += c.covered;
  counts.uncovered += c.uncovered;
  counts.isolated += c.isolated;
  counts.doublyCovered += c.doublyCovered;
  counts.overlapped += c.overlapped;
  counts.nodataCovered += c.nodataCovered;
  counts.domainAreaPixels += c.domainAreaPixels;
  counts.errorBeyondRounding = largerOrNan(counts.errorBeyondRounding, c.errorBeyondRounding);
  if (c.worst) {
    // If errors are equal, the sample with the smallest number stays.
    const bool larger = !counts.worst || c.maxAbsError > counts.maxAbsError;
    const bool earlier =
        counts.worst && c.maxAbsError == counts.maxAbsError && c.worst->sample < counts.worst->sample;
    if (larger || earlier) {
      counts.maxAbsError = c.maxAbsError;
      counts.worst = c.worst;
    }
  }
  sumSquares += later.sumSquares;
  sumAbs += later.sumAbs;
  sum += later.sum;
}

MeasureReport BandTotals::finish() const {
  MeasureReport report = counts;
  if (report.covered > 0) {
    const auto n = static_cast<double>(report.covered);
    report.rmsError = std::sqrt(sumSquares / n);
    report.meanAbsError = sumAbs / n;
    report.meanError = sum / n;
  }
  return report;
}

SampleRecorder::SampleRecorder(const Inputs& in, std::size_t samples)
    : mesh_(in.mesh), mask_(in.options.mask), rasters_(in.rasters) {
  if (!rasters_) return;
  rasters_->tinHeights.resize(samples);
  rasters_->errors.resize(samples);
}

Result<MeasureReport> measureBands(const Inputs& in, const TriangleBands& bands,
                                   const std::function<BandTotals(std::size_t band)>& scan) {
  std::vector<BandTotals> totals(bands.count());
  ARETE_CHECK(forEachTask(totals.size(), in.context, "measuring",
                          [&](std::size_t band) { totals[band] = scan(band); }));

  BandTotals all;
  for (const BandTotals& band : totals) all.add(band);
  MeasureReport report = all.finish();
  report.triangles = in.mesh.triangles.size();
  report.vertices = in.mesh.positions.size();
  report.degenerateTriangles = bands.degenerate;
  report.tinAreaPixels = bands.areaPixels;
  return report;
}

}  // namespace arete::measuring

namespace arete {

double planTolerancePixels(const MeasureOptions& options, const Georeference& georeference) {
  const auto& g = georeference.geoTransform;
  const double area = std::abs(georeference.determinant());
  // Coordinates are doubles: far from the origin few digits are left for a small pixel.
  constexpr double kRounding = 0x1p-51;
  const double x = std::max(std::abs(options.planRounding.x), kRounding * std::abs(g[0])),
               y = std::max(std::abs(options.planRounding.y), kRounding * std::abs(g[3]));
  if (!(area > 0)) return options.planTolerancePixels;
  return measuring::raisedTolerance(options, {(x * std::abs(g[5]) + y * std::abs(g[2])) / area,
                                              (x * std::abs(g[4]) + y * std::abs(g[1])) / area});
}

}  // namespace arete
