// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/similarity.h"
#include "io/query/scene/open_scene.h"
#include "surface/model/surface_model.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// From the coordinates of a surface's file to a space whose z points up, on the same origin.
///
/// @param up "y" or "z"; empty: as the model says, else z
Similarity zUp(const SurfaceModel& model, const std::string& up);

/// What of a surface stands at its place, in the coordinates of its file: 0,0,0, or the middle of the bottom
/// of its box as it is turned. O(vertices of the root and all nodes) for a base.
Vec3 pivotOf(const StatedObject& stated, const SurfaceModel& model);

/// Where a surface of a scene stands: from the metric space of its multitriangulation to that of the scene's
/// terrain (terrain/model/camera.h), which may be mirrored against the map; without one to the scene's
/// numbers.
Similarity placedInScene(const PlacedObject& object, const SurfaceModel& model, const TerrainModel* terrain);

}  // namespace arete
