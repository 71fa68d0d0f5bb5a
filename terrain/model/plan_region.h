// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/vec.h"
#include "engine/criteria/region.h"
#include "engine/mt/multitriangulation.h"
#include "terrain/model/heightfield.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// A region that was drawn on the map, in source coordinates, where the triangles are: in plan coordinates. A
/// box comes as a ring, so that it stays one on the map where the grid is rotated. Its distance is in metres
/// on the ground (in source units without a CRS), as the metric of the model has them: on a geographic CRS
/// that is true in the middle of the DEM and off by the change of a degree's length towards its edges.
/// O(vertices).
Region planRegion(RegionShape sourceShape, const TerrainModel& model);
Region planRegion(RegionShape sourceShape, const RasterHeightfield& heightfield);
Region planRegion(RegionShape sourceShape, const PointHeightfield& heightfield);

/// Whether any of the domain lies in the region: whether it meets a triangle of the root. O(root triangles).
bool meetsDomain(const Region& region, const MultiTriangulation& mt);

/// One value per sample: whether it lies in the region, which is in plan coordinates. O(samples).
std::vector<std::uint8_t> samplesInside(const Region& region, const RasterHeightfield& heightfield);
std::vector<std::uint8_t> samplesInside(const Region& region, const PointHeightfield& heightfield);

}  // namespace arete
