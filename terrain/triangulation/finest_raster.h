// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/simplify/live_mesh.h"
#include "terrain/model/heightfield.h"

namespace arete {

/// The finest triangulation of a raster, laid out directly: a cell with four valid corners gives two
/// triangles, split by the diagonal from its upper-left to its lower-right sample; one with three valid
/// corners gives one. Corners are sample indices, counter-clockwise in (column, row). It is (constrained)
/// Delaunay up to cocircular ties. O(samples).
std::vector<std::array<std::uint32_t, 3>> finestTriangulation(const RasterHeightfield& heightfield);

/// The same triangles in the same order as a mesh; `pinched` receives the vertices with more than one fan.
/// O(samples), parallel.
LiveMesh finestMesh(const RasterHeightfield& heightfield, std::vector<VertexId>& pinched);

}  // namespace arete
