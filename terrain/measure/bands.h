// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/parallel/run_context.h"
#include "terrain/measure/measure.h"
#include "terrain/measure/triangle.h"

/// The common parts of measuring on a raster and measuring on points: bands of the plan that are independent
/// tasks, the triangles of each band, what they leave at each sample, and the report.
namespace arete::measuring {

/// What a measurement is given beside the samples.
struct Inputs {
  const TriangleMesh& mesh;
  const MeasureOptions& options;
  const RunContext& context;
  MeasureRasters* rasters;  ///< null: none are filled
};

/// Errors: those of the mesh; unsupported: too many triangles; usage with the culprit "mask" or
/// "planTolerancePixels": an option out of range.
/// @param heightfield  the status of the heightfield, returned first
/// @param samples  how many samples the heightfield has
Status checkInputs(const Inputs& in, const Status& heightfield, std::size_t samples);

/// @return options.planTolerancePixels, or twice the rounding where that is more, at most kMostPlanTolerance
double raisedTolerance(const MeasureOptions& options, Vec2 roundingPixels);

/// The triangles that reach each band, in the mesh's order. Band b has the rows floor(y / rowHeight) in
/// [b * rowsPerBand, (b + 1) * rowsPerBand).
struct TriangleBands {
  std::vector<std::uint64_t> begin;  ///< per band its first entry of `triangles`, and the number of entries
  std::vector<std::uint32_t> triangles;
  std::uint64_t degenerate = 0;  ///< triangles that are nowhere thicker than the tolerance
  double areaPixels = 0;         ///< sum of all triangles' areas

  std::size_t count() const { return begin.size() - 1; }
  std::span<const std::uint32_t> of(std::size_t band) const {
    return {triangles.data() + begin[band], triangles.data() + begin[band + 1]};
  }
};

/// A counting sort of the triangles by band. O(triangles + entries).
/// @param plan  the mesh's vertices in pixels
/// @param rows, rowHeight  the bands together have the rows 0 .. rows - 1, each rowHeight pixels high
/// @param tolerance  in pixels: a triangle reaches a band that is within twice this of it
/// @param keepsThin  whether degenerate triangles are listed; they are counted in any case
TriangleBands sortIntoBands(const TriangleMesh& mesh, std::span<const Vec2> plan, std::int64_t rows,
                            double rowHeight, std::int64_t rowsPerBand, double tolerance,
                            bool keepsThin = false);

/// Sets `triangle` to a triangle of the mesh, with the plan positions in pixels.
/// @return false where it is nowhere thicker than the tolerance
inline bool setTriangle(PlanTriangle& triangle, const TriangleMesh& mesh, std::span<const Vec2> plan,
                        std::uint32_t id, double tolerance) {
  const auto& v = mesh.triangles[id];
  return triangle.set({plan[v[0]], plan[v[1]], plan[v[2]]},
                      {mesh.positions[v[0]].z, mesh.positions[v[1]].z, mesh.positions[v[2]].z}, tolerance);
}

/// What the triangles of one band have left at each of its samples.
class Gathered {
 public:
  explicit Gathered(std::size_t samples)
      : z_(samples, std::numeric_limits<double>::quiet_NaN()),
        triangle_(samples),
        strict_(samples),
        turn_(samples) {}

  /// A triangle meets a sample. Of several triangles the one with the largest error is kept.
  /// @param height  the sample's own height, NaN for NODATA
  /// @param z  the height of the triangle there
  /// @param strict  whether the sample is strictly inside the triangle
  /// @param turn  the part of a full turn that the triangle fills around the sample
  void add(std::size_t sample, double height, std::uint32_t triangle, double z, bool strict, float turn) {
    const double before = z_[sample];
    if (std::isnan(before) || std::abs(z - height) > std::abs(before - height)) {
      z_[sample] = z;
      triangle_[sample] = triangle;
    }
    if (strict && strict_[sample] < 2) ++strict_[sample];
    turn_[sample] += turn;
  }

  std::size_t size() const { return z_.size(); }
  bool isCovered(std::size_t sample) const { return !std::isnan(z_[sample]); }
  double z(std::size_t sample) const { return z_[sample]; }
  std::uint32_t triangle(std::size_t sample) const { return triangle_[sample]; }
  bool isDoublyCovered(std::size_t sample) const { return strict_[sample] > 1; }
  bool isOverlapped(std::size_t sample) const {
    return strict_[sample] > 1 || turn_[sample] > kFullTurn + kTurnTolerance;
  }
  bool isInterior(std::size_t sample) const {
    return strict_[sample] > 0 || turn_[sample] >= kFullTurn - kTurnTolerance;
  }

 private:
  static constexpr float kTurnTolerance = 1e-3f;

  std::vector<double> z_;  // NaN = uncovered
  std::vector<std::uint32_t> triangle_;
  std::vector<std::uint8_t> strict_;
  std::vector<float> turn_;
};

/// Counts and sums of one band. They are added in the order of the bands, so that no rounding depends on the
/// number of threads.
struct BandTotals {
  MeasureReport counts;
  double sumSquares = 0, sumAbs = 0, sum = 0;

  void addMeasured(const MeasuredSample& sample);
  /// Raises MeasureReport::errorBeyondRounding to that of one more sample.
  /// @param corner  of the triangle at the sample, in the plan of `at`
  void addBeyondRounding(const MeasuredSample& sample, const std::array<Vec3, 3>& corner, Vec2 at);
  /// Takes part in the largest error only.
  void addLargest(const MeasuredSample& sample);
  void add(const BandTotals& later);
  /// @return the counts, with the means computed from the sums
  MeasureReport finish() const;
};

/// Writes the results at the samples to the caller's rasters, and applies the mask. Thread-safe for calls on
/// different samples.
class SampleRecorder {
 public:
  /// Resizes the rasters, where there are any, to one value per sample.
  SampleRecorder(const Inputs& in, std::size_t samples);

  /// Stores the TIN's height at a sample, NaN where no triangle covers it.
  /// @return whether the sample counts: the mask does not leave it out
  bool begin(std::size_t sample, double tinHeight) {
    if (rasters_) {
      rasters_->tinHeights[sample] = tinHeight;
      rasters_->errors[sample] = std::numeric_limits<double>::quiet_NaN();
    }
    return mask_.empty() || mask_[sample] != 0;
  }
  /// Adds a covered sample to the totals, and stores its error.
  /// @param plan  positions of the mesh's vertices in the plan in which the sample is at `at`; called only
  ///              where the sample may count most
  template <class Plan>
  void add(const MeasuredSample& sample, Vec2 at, const Plan& plan, BandTotals& totals) {
    totals.addMeasured(sample);
    if (rasters_) rasters_->errors[sample.sample] = sample.error();
    addBeyondRounding(sample, at, plan, totals);
  }
  /// As add(), for a sample that is counted elsewhere: it takes part in the largest errors only.
  template <class Plan>
  void addRepeated(const MeasuredSample& sample, Vec2 at, const Plan& plan, BandTotals& totals) {
    totals.addLargest(sample);
    addBeyondRounding(sample, at, plan, totals);
  }

 private:
  template <class Plan>
  void addBeyondRounding(const MeasuredSample& sample, Vec2 at, const Plan& plan, BandTotals& totals) {
    if (std::abs(sample.error()) <= totals.counts.errorBeyondRounding) return;
    std::array<Vec3, 3> corner;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t v = mesh_.triangles[sample.triangle][i];
      const Vec2 p = plan(v);
      corner[i] = {p.x, p.y, mesh_.positions[v].z};
    }
    totals.addBeyondRounding(sample, corner, at);
  }

  const TriangleMesh& mesh_;
  std::span<const std::uint8_t> mask_;
  MeasureRasters* rasters_;
};

/// Calls visit(triangle, id, hasArea) for each triangle of a band; hasArea as setTriangle() returns it.
/// @return false where the work was cancelled meanwhile
template <class Visit>
bool forTrianglesOf(std::size_t band, const TriangleBands& bands, const Inputs& in,
                    std::span<const Vec2> plan, double tolerance, const Visit& visit) {
  constexpr std::size_t kTrianglesPerCancelCheck = 8192;
  PlanTriangle triangle;
  std::size_t untilCheck = kTrianglesPerCancelCheck;
  for (const std::uint32_t id : bands.of(band)) {
    if (--untilCheck == 0) {
      if (in.context.cancelled()) return false;
      untilCheck = kTrianglesPerCancelCheck;
    }
    const bool hasArea = setTriangle(triangle, in.mesh, plan, id, tolerance);
    visit(triangle, id, hasArea);
  }
  return true;
}

/// Scans every band in parallel and adds up what they return. Errors: interrupted.
Result<MeasureReport> measureBands(const Inputs& in, const TriangleBands& bands,
                                   const std::function<BandTotals(std::size_t band)>& scan);

}  // namespace arete::measuring
