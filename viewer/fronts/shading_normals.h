// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "surface/model/surface_model.h"

namespace arete {

/// For every vertex of the MT a unit normal of the source, so that light does not change with the level of
/// detail: the mean of its faces, weighted by their areas. Zero where a face is turned away from it by more
/// than 45 degrees, as on the edge of a box: there the drawn triangle's own normal is to be used.
/// O(faces of the source).
std::vector<Vec3> shadingNormals(const SurfaceModel& model);

}  // namespace arete
