// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/query/scene/open_scene.h"
#include "terrain/sight/paths.h"

namespace arete {

/// Adds the meshes of a scene to answers over its terrain: where one is in the way before the terrain is, the
/// line is blocked there. Clearances and Fresnel zones stay of the terrain alone.
///
/// @param model the first terrain, or an empty model.
/// @return by path, what is first in the way: an object's name, "terrain", "nodata" or nothing. Errors:
/// interrupted.
Result<std::vector<std::string>> addMeshesInTheWay(const OpenScene& scene, const TerrainModel& model,
                                                   std::span<const SightPath> paths, const SightEarth& earth,
                                                   std::vector<Result<SightPathAnswer>>& answers,
                                                   const RunContext& context);

}  // namespace arete
