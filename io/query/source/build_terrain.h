// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/geo/dem/dem_reader.h"
#include "terrain/builder/build.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// Errors: unsupported, naming the path: the machine has less memory than a build of the heights takes at the
/// least. O(samples).
Status checkBuildMemory(const DemHeightfield& heights, const std::string& path);

/// Builds a model with the features that `arete build` keeps by default. Errors: as checkBuildMemory(),
/// chooseFixedVertices() and build().
Result<TerrainModel> buildTerrain(const DemHeightfield& heights, const std::string& path,
                                  BuildOptions options, const RunContext& context = {});

}  // namespace arete
