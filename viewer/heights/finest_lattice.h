// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// Heights on a lattice over the plan: node (i, j) stands at plan position first + (i, j) * step.
struct HeightLattice {
  std::uint32_t columns = 0, rows = 0;
  Vec2 first, step;
  std::vector<double> heights = {};  ///< row by row; NaN without data
  /// Each cell is the one or two triangles of the finest triangulation that RasterCells says: heights between
  /// nodes are exact, too.
  bool isExact = false;
};

/// The samples of a raster without isolated ones, which are in no triangle; exact where every finest triangle
/// lies in a cell as RasterCells has it. Precondition: model.isRaster. O(samples).
HeightLattice latticeOfSamples(const TerrainModel& model);

/// Heights of the finest triangulation at the nodes of a lattice whose steps have one length on the ground,
/// in the middle of the model; nodes beside a border, within a step of it, are extrapolated.
///
/// @param step  in metric units; 0 = a quarter of the mean spacing of vertices, or as many nodes as `most`
/// @param most  nodes; a step that needs more of them is widened
/// O(nodes + triangles). Errors: invalidData: no triangle.
Result<HeightLattice> latticeOfTriangles(const TerrainModel& model, double step, std::uint64_t most);

}  // namespace arete
