// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/parallel/run_context.h"
#include "surface/fit/fit_lines.h"

namespace arete {

struct SurfaceFitOptions {
  /// Steps at most; it ends sooner where a step gains less than a hundredth, and where the root mean square
  /// and lines are off by no more than the rounding of the source's coordinates: an exact cut is not moved.
  int steps = 10;
  /// Samples of the source; 0: 40 for each triangle of the cut, or 16 for each face of the source but at most
  /// 100 000, whichever is more.
  std::uint64_t samples = 0;
  /// Of a sample of a line, beside one of the area: lines are seen first, and attributes next to them
  /// follow the line.
  double lineWeight = 16;
};

/// Where the vertices of a cut are moved to.
struct FittedSurface {
  std::vector<Vec3> positions;
  /// Root mean square of the distances of samples of the area and of borders.
  double rmsBefore = 0, rmsAfter = 0;
  /// The largest distance of a sample of the source's lines from the line of the cut.
  double lineBefore = 0, lineAfter = 0;
  int steps = 0;
};

/// Moves the vertices of a cut so that the mean square of the distances from the source to it becomes small,
/// as in [HoppeMeshOptimization1993]: samples of the source are assigned to their nearest
/// points, the vertices are moved for these assignments, and so on. Borders are fitted to borders, and lines
/// to the ways of the source that they stand for. No
/// triangle turns by more than 60 degrees from where it was, and no edge becomes a fold of more than 120
/// degrees. Positions are in one unit; scaled by a power of two, the result is. The result does not depend on
/// the threads.
/// @param isHeld by vertex of the cut: it stays (heldVertices())
/// @param lines  of the cut, whose vertices are not held where they may move; empty: no vertex moves along
/// one Errors: invalidData: a mesh that does not validate(), or a source without area; interrupted. O(steps *
/// (samples log triangles + triangles)); about 100 bytes a sample and 700 a triangle.
Result<FittedSurface> fitSurface(const TriangleMesh& cut, const std::vector<std::uint8_t>& isHeld,
                                 const TriangleMesh& source, const SurfaceFitOptions& options = {},
                                 const RunContext& context = {}, const FitLines& lines = {});

}  // namespace arete
