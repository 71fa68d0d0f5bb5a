// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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

/// What measuring on a raster and measuring on points have in common: bands of the plan that are independent
/// tasks, the triangles of each, and what is gathered at each sample.
namespace arete::measuring {

/// The mesh and the options make sense, for that many samples.
Status checkInputs(const TriangleMesh& mesh, std::size_t samples, const MeasureOptions& options);

/// options.planTolerancePixels, or twice the rounding where that is more, at most kMostPlanTolerance.
double raisedTolerance(const MeasureOptions& options, Vec2 roundingPixels);

/// Which triangles reach each band, in the mesh's order. Band b holds the rows floor(y / rowHeight) of
/// [b * rowsPerBand, (b + 1) * rowsPerBand).
struct TriangleBands {
  std::vector<std::uint64_t> begin;  ///< one more than bands
  std::vector<std::uint32_t> triangles;
  std::uint64_t degenerate = 0;
  double areaPixels = 0;

  std::span<const std::uint32_t> of(std::size_t band) const {
    return {triangles.data() + begin[band], triangles.data() + begin[band + 1]};
  }
};

/// `plan` holds the mesh's vertices in pixels. Degenerate triangles are counted and, but for `keepsThin`,
/// left out. O(triangles + entries).
TriangleBands sortIntoBands(const TriangleMesh& mesh, std::span<const Vec2> plan, std::int64_t rows,
                            double rowHeight, std::int64_t rowsPerBand, double tolerance,
                            bool keepsThin = false);

/// The corners and heights of a triangle of the mesh, with the plan positions in pixels.
inline bool setTriangle(PlanTriangle& triangle, const TriangleMesh& mesh, std::span<const Vec2> plan,
                        std::uint32_t id, double tolerance) {
  const auto& v = mesh.triangles[id];
  return triangle.set({plan[v[0]], plan[v[1]], plan[v[2]]},
                      {mesh.positions[v[0]].z, mesh.positions[v[1]].z, mesh.positions[v[2]].z}, tolerance);
}

/// What the triangles of one band leave at each of its samples.
class Gathered {
 public:
  explicit Gathered(std::size_t samples)
      : z_(samples, std::numeric_limits<double>::quiet_NaN()),
        triangle_(samples),
        strict_(samples),
        turn_(samples) {}

  /// `height` is the sample's own, NaN for NODATA. Of several triangles the one with the largest error stays.
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

/// Counts and sums of one band; added up in the order of the bands, so that no rounding depends on the
/// threads.
struct BandTotals {
  MeasureReport counts;
  double sumSquares = 0, sumAbs = 0, sum = 0;

  void addMeasured(const MeasuredSample& sample);
  void add(const BandTotals& later);
  /// The finished report: means from sums.
  MeasureReport finish() const;
};

/// Runs task(band) for every band on the context's threads; reports progress under `stage`. Returns
/// interrupted when cancelled.
Status forEachBand(std::size_t bands, const RunContext& context, const char* stage,
                   const std::function<void(std::size_t band)>& task);

/// How many triangles a band goes through between two looks at the cancel flag.
inline constexpr std::size_t kTrianglesPerCancelCheck = 8192;

}  // namespace arete::measuring
