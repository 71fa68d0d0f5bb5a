// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/cut/cut.h"
#include "terrain/fit/fit.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// A cut as a mesh for other programs.
struct TinExport {
  /// Positions in source coordinates, heights in the DEM's vertical unit. Triangles are counter-clockwise on
  /// the map, whatever the orientation of the raster's grid.
  TriangleMesh mesh;
  std::vector<float> errors;            ///< per triangle: as stored or as fitted, rounded outwards
  std::vector<std::uint32_t> vertexOf;  ///< by vertex: its number in the model's MT
  Vec3 origin;  ///< for formats of 32-bit floats, in source coordinates; the same for all cuts of a model
};

/// O(size of the cut). Precondition: the cut is one of the model's. Errors: outOfMemory.
Result<TinExport> exportTin(const TerrainModel& model, const Cut& cut);
/// With the heights and errors of the fit; the errors are rounded outwards.
Result<TinExport> exportTin(const TerrainModel& model, const FittedCut& fitted);

}  // namespace arete
