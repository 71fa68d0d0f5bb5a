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

/// The independent check of an error bound: measures any mesh against the samples that it approximates.
///
/// This room shares no code with the build and uses nothing that the build computed: its inputs are
/// positions, triangles and heights. Errors are z_TIN - z_DEM in the DEM's vertical unit.

/// One sample and the TIN's height there.
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

/// The result of a measurement. A "pixel" is one step of the grid; for points, their mean spacing.
///
/// valid = covered + uncovered + isolated. Samples outside MeasureOptions::mask are in none of the counts. A
/// first column that is repeated (Georeference::repeatsFirstColumn) counts once; errors of both are compared.
struct MeasureReport {
  std::uint64_t triangles = 0;
  std::uint64_t vertices = 0;
  /// Triangles thinner than the plan tolerance: they cover nothing, but for points that they hold exactly.
  std::uint64_t degenerateTriangles = 0;

  std::uint64_t samples = 0;    ///< all of them, NODATA included
  std::uint64_t valid = 0;      ///< with a height
  std::uint64_t covered = 0;    ///< valid, not isolated, in a triangle or within the plan tolerance of one
  std::uint64_t uncovered = 0;  ///< valid, not isolated, in no triangle
  std::uint64_t isolated = 0;   ///< valid, in no cell with three valid corners: left out below
  std::uint64_t doublyCovered = 0;  ///< strictly inside more than one triangle
  /// Samples whose triangles fill more than one full turn around them: the doubly covered ones, and those
  /// that overlapping triangles touch with an edge or a corner only. (In a TIN at full resolution every
  /// sample is a corner.)
  std::uint64_t overlapped = 0;
  /// NODATA samples strictly inside the TIN: inside one triangle, or surrounded by triangles that fill the
  /// whole turn around them.
  std::uint64_t nodataCovered = 0;

  double maxAbsError = 0;  ///< over the covered samples, as are the next three; 0 when there are none
  double rmsError = 0;
  double meanAbsError = 0;
  double meanError = 0;  ///< signed, z_TIN - z_DEM
  /// The least bound that the errors keep but for rounding: the largest of |error| - 4 ulp, the ulp being
  /// that of the largest |height| of the sample and of its triangle's corners.
  double errorBeyondRounding = 0;
  std::optional<MeasuredSample> worst;  ///< where maxAbsError is; the first in sample order among equals

  double tinAreaPixels = 0;     ///< sum of the plan areas of the triangles, in square pixels
  double domainAreaPixels = 0;  ///< of the cells with three or four valid corners; rasters only
};

struct MeasureOptions {
  /// How far outside a triangle a sample still counts as covered by it, and how deep inside it must be to be
  /// strictly inside, in pixels; between 0 and 0.25. A vertex this near to a raster sample is moved onto it.
  double planTolerancePixels = 1e-6;
  /// The rounding error of the mesh's own x and y in source units, as in float32 files; 0 = exact. Raises the
  /// plan tolerance to twice as much, at most kMostPlanTolerance, so that samples on a border stay covered.
  Vec2 planRounding = {};
  /// Empty, or one value per sample: 0 leaves the sample out (a region of interest).
  std::span<const std::uint8_t> mask = {};
};

/// The largest plan tolerance that MeasureOptions::planRounding can lead to, in pixels.
inline constexpr double kMostPlanTolerance = 0.1;

/// The plan tolerance in use on a grid, in pixels: that of the options, raised for planRounding, or for the
/// rounding of doubles where the grid is so far from the origin that this is more.
double planTolerancePixels(const MeasureOptions& options, const Georeference& georeference);

/// Rasters that measure() can fill beside the report: one value per sample, in sample order.
struct MeasureRasters {
  std::vector<double> tinHeights;  ///< the TIN's height; NaN where uncovered
  std::vector<double> errors;      ///< z_TIN - z_DEM where it is in the statistics, NaN elsewhere
};

/// Measures a mesh against every sample of a raster. A sample in several triangles has the largest of their
/// errors. The result is the same for any number of threads. O(samples + triangles * bands they reach) time;
/// about 20 bytes per vertex and 4 per triangle of memory beside the inputs.
/// @param mesh  positions in source coordinates, z in the DEM's vertical unit; either orientation
/// @param rasters  filled where not null
/// Errors: invalidData: the mesh or the heightfield does not validate(), or a vertex is too far away;
/// usage, culprit "mask" or "planTolerancePixels": an option out of range; unsupported: 2^32 triangles or
/// more; interrupted.
Result<MeasureReport> measure(const TriangleMesh& mesh, const RasterHeightfield& dem,
                              const MeasureOptions& options = {}, const RunContext& context = {},
                              MeasureRasters* rasters = nullptr);

/// The same for scattered points; no point is isolated or NODATA. Unless the mesh's x and y are rounded,
/// which triangles hold a point, edges included, is decided exactly, however thin they are, and they give the
/// TIN's height there. The plan tolerance applies to points that no triangle holds, and to overlaps.
Result<MeasureReport> measure(const TriangleMesh& mesh, const PointHeightfield& points,
                              const MeasureOptions& options = {}, const RunContext& context = {},
                              MeasureRasters* rasters = nullptr);

/// What checkPromise() tolerates.
struct ExpectOptions {
  bool allowCoveredNodata = false;  ///< for models built with a rim tolerance
};

/// Checks that every sample is covered, none twice, no NODATA is covered (unless allowed), and that no error
/// exceeds the expected one by more than MeasureReport::errorBeyondRounding leaves out. Errors:
/// brokenPromise: all of these that fail, the error first, with figures.
Status checkPromise(const MeasureReport& report, double expectedError, const ExpectOptions& options = {});

/// Whether checkPromise() succeeds.
bool keepsPromise(const MeasureReport& report, double expectedError, const ExpectOptions& options = {});

}  // namespace arete
