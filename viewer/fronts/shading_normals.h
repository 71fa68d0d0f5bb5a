// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "surface/model/surface_model.h"

namespace arete {

/// For every vertex of the MT a unit normal of the source, so that light does not change with the level of
/// detail: as smoothCorners() makes it (surface/normals/smooth_corners.h) with creases beyond kCreaseDegrees.
/// Zero where corners differ, as on the edge of a box: there the drawn triangle's own normal is to be used.
/// O(n log n) of the faces of the source.
std::vector<Vec3> shadingNormals(const SurfaceModel& model);

}  // namespace arete
