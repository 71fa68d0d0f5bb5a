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

/// Transforms a region from source coordinates to plan coordinates, those of the triangles. A box is given as
/// a ring, so that it stays a box on the map where the grid is rotated. RegionShape's distance is in metres
/// on the ground (in source units without a CRS), by the metric of the model: on a geographic CRS that is
/// exact in the middle of the DEM, and off by the change of a degree's length towards its edges. O(vertices).
Region planRegion(RegionShape sourceShape, const TerrainModel& model);
Region planRegion(RegionShape sourceShape, const RasterHeightfield& heightfield);
Region planRegion(RegionShape sourceShape, const PointHeightfield& heightfield);

/// Whether the region meets the domain, that is, a triangle of the root. O(root triangles).
bool meetsDomain(const Region& region, const MultiTriangulation& mt);

/// Which samples lie in a region. O(samples).
/// @param region  in plan coordinates
/// @return one value per sample: 1 inside, 0 outside; usable as MeasureOptions::mask
std::vector<std::uint8_t> samplesInside(const Region& region, const RasterHeightfield& heightfield);
std::vector<std::uint8_t> samplesInside(const Region& region, const PointHeightfield& heightfield);

}  // namespace arete
