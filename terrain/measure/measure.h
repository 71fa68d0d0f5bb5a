// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/heightfield.h"

namespace arete {

/// The independent check of the promise: a mesh that somebody hands us, against the samples it claims to be
/// near.
///
/// Nothing here comes from the builder, and nothing the builder computed is believed: only positions,
/// triangles and heights count. Errors are z_TIN - z_DEM in the DEM's vertical unit.

/// One sample that was compared, and what stood over it.
struct MeasuredSample {
  std::uint64_t sample = 0;  ///< row-major index in the raster, or the index of the point
  std::uint32_t column = 0;  ///< of a raster sample; 0 for a point
  std::uint32_t row = 0;     ///< of a raster sample; 0 for a point
  double x = 0, y = 0;       ///< source coordinates of the sample
  double demHeight = 0;
  double tinHeight = 0;
  std::uint32_t triangle = 0;  ///< index into the mesh

  double error() const { return tinHeight - demHeight; }
};

/// What the measurement found. "Pixel" is one step of the grid; for points, their mean spacing.
///
/// valid = covered + uncovered + isolated. Samples outside MeasureOptions::mask are in no count at all.
struct MeasureReport {
  std::uint64_t triangles = 0;
  std::uint64_t vertices = 0;
  std::uint64_t degenerateTriangles =
      0;  ///< no plan area (thinner than the plan tolerance): they cover nothing but points they hold exactly

  std::uint64_t samples = 0;    ///< all of them, NODATA included
  std::uint64_t valid = 0;      ///< with a height
  std::uint64_t covered = 0;    ///< valid, not isolated, in a triangle or within the plan tolerance of one
  std::uint64_t uncovered = 0;  ///< valid, not isolated, in no triangle
  std::uint64_t isolated = 0;   ///< valid, in no cell with three valid corners: in no statistic below
  std::uint64_t doublyCovered = 0;  ///< strictly inside more than one triangle
  /// Samples whose triangles fill more than one full turn around them: the doubly covered ones, and those
  /// that overlapping triangles touch with an edge or a corner only, which is all there is to see in a TIN at
  /// full resolution.
  std::uint64_t overlapped = 0;
  /// NODATA samples strictly inside the TIN: of one triangle, or where triangles close the whole turn around
  /// them.
  std::uint64_t nodataCovered = 0;

  double maxAbsError = 0;  ///< over the covered samples, as are the next three; 0 when there are none
  double rmsError = 0;
  double meanAbsError = 0;
  double meanError = 0;      ///< signed, z_TIN - z_DEM
  double largestHeight = 0;  ///< largest |height| compared, of either surface: what rounding is relative to
  std::optional<MeasuredSample> worst;  ///< where maxAbsError is; the first in sample order among equals

  double tinAreaPixels = 0;     ///< sum of the plan areas of the triangles, in square pixels
  double domainAreaPixels = 0;  ///< of the cells with three or four valid corners; rasters only
};

struct MeasureOptions {
  /// How far outside a triangle a sample still counts as covered by it, and how deep inside it must be to be
  /// strictly inside, in pixels. Vertices this near a raster sample are taken to stand on it.
  double planTolerancePixels = 1e-6;
  /// How far the mesh's own x and y may be rounded, in source units (float32 files; 0 = not): raises the plan
  /// tolerance to twice as much, at most kMostPlanTolerance, so that a border stays where it was meant to be.
  Vec2 planRounding = {};
  /// When not empty: one value per sample, 0 = leave this sample out (a region of interest).
  std::span<const std::uint8_t> mask = {};
};

/// The largest plan tolerance that rounding can bring about, in pixels.
inline constexpr double kMostPlanTolerance = 0.1;

/// The plan tolerance that options come to on a grid, in pixels. Where the grid is so far from the origin
/// that doubles themselves round more, it is raised as for a mesh that is rounded so.
double planTolerancePixels(const MeasureOptions& options, const Georeference& georeference);

/// Rasters that the measurement can hand back besides the report: one value per sample, in sample order.
struct MeasureRasters {
  std::vector<double> tinHeights;  ///< the TIN sampled back on the grid; NaN where uncovered
  std::vector<double> errors;      ///< z_TIN - z_DEM where it is in the statistics, NaN elsewhere
};

/// Measures `mesh` (positions in source coordinates, either orientation, z in the DEM's vertical unit)
/// against every sample. A sample in several triangles has the largest of its errors. `rasters`, when given,
/// is filled. Errors: invalidData for a mesh or heightfield that makes no sense (validate() of each),
/// interrupted. The result is the same for any number of threads. O(samples + triangles * bands they touch)
/// time; about 20 bytes per vertex and 4 per triangle of memory beside the inputs.
Result<MeasureReport> measure(const TriangleMesh& mesh, const RasterHeightfield& dem,
                              const MeasureOptions& options = {}, const RunContext& context = {},
                              MeasureRasters* rasters = nullptr);

/// The same for scattered points; no point is isolated or NODATA. Unless the mesh's x and y are rounded,
/// which triangles hold a point, edges included, is decided exactly, however thin they are, and these alone
/// say how high the TIN is there; the plan tolerance is for points that none holds, and tells overlaps.
Result<MeasureReport> measure(const TriangleMesh& mesh, const PointHeightfield& points,
                              const MeasureOptions& options = {}, const RunContext& context = {},
                              MeasureRasters* rasters = nullptr);

/// What a promise may leave open.
struct ExpectOptions {
  bool allowCoveredNodata = false;  ///< for models built with a rim tolerance
};

/// What "within E" means in doubles: E + max(1e-6 unit, 4 ulp of the largest height compared).
double acceptedError(const MeasureReport& report, double expectedError);

/// Ok when every sample is covered, none twice, no NODATA is covered (unless allowed) and the largest error
/// is within acceptedError(); else a brokenPromise error that says which of these fails first, and by how
/// much.
Status checkPromise(const MeasureReport& report, double expectedError, const ExpectOptions& options = {});

/// checkPromise() as a yes or no.
bool keepsPromise(const MeasureReport& report, double expectedError, const ExpectOptions& options = {});

}  // namespace arete
