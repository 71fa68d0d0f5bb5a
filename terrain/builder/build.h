// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/build_options.h"
#include "terrain/model/heightfield.h"
#include "terrain/model/terrain_model.h"
#include "terrain/triangulation/finest_points.h"

namespace arete {

/// Builds the multitriangulation of a heightfield: its finest triangulation, reduced to the domain's corners
/// and the fixed vertices by removals of independent sets of vertices [deBergDobrindt1995].
///
/// The result depends on the heightfield and the options only: the same bytes for any number of threads.
/// Errors: degenerate (no cell or triangle, all collinear, one plan position with two heights), invalidData,
/// usage (options out of range), interrupted. O(n log n) expected. Peak memory about 300 bytes per sample.
Result<TerrainModel> build(const RasterHeightfield& heightfield, const BuildOptions& options = {},
                           const RunContext& context = {});
Result<TerrainModel> build(const PointHeightfield& heightfield, const BuildOptions& options = {},
                           const RunContext& context = {});
/// The checks that build() starts with, for callers that do other work before calling it. O(points).
Status checkBuild(const PointHeightfield& heightfield, const BuildOptions& options);
/// `finest`: the result of finestPoints() for the same points.
Result<TerrainModel> build(const PointHeightfield& heightfield, FinestPoints finest,
                           const BuildOptions& options = {}, const RunContext& context = {});

}  // namespace arete
