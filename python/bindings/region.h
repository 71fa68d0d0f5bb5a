// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/criteria/region.h"
#include "engine/parallel/run_context.h"
#include "io/query/request/cut_request.h"
#include "terrain/model/heightfield.h"
#include "terrain/model/terrain_model.h"

namespace arete::python {

/// A box; polygons of an outer ring and holes; or a text: the name of a file or numbers of a box, or else
/// a table of WKT, the CRS of these (empty: the source's, a file's own), and a distance around
/// them.
using RegionBox = std::array<double, 4>;
using RegionPolygons = std::vector<std::vector<std::vector<std::array<double, 2>>>>;
using RegionOfText = std::tuple<std::string, std::string, std::string, double>;
using AskedRegion = std::variant<RegionBox, RegionPolygons, RegionOfText>;

/// The region in the plan of a model. Errors: as readRegionArgument() and regionArgumentOf(), with the
/// culprit "region"; usage: it does not meet the terrain.
Result<Region> planRegionOf(const AskedRegion& asked, const TerrainModel& model, Warnings& warnings,
                            const RunContext& context);

/// 1 for each sample in the region. Errors: as planRegionOf(); usage: it holds none.
Result<std::vector<std::uint8_t>> samplesIn(const AskedRegion& asked, const RasterHeightfield& field,
                                            Warnings& warnings, const RunContext& context);
Result<std::vector<std::uint8_t>> samplesIn(const AskedRegion& asked, const PointHeightfield& field,
                                            Warnings& warnings, const RunContext& context);

/// Says in a request how the region was stated, as a certificate has it.
void stateRegion(const AskedRegion& asked, CutRequest& request);

}  // namespace arete::python
