// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/criteria/view_error.h"
#include "io/format/required_error.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// What a view is likely to want of a model: the error that it allows at the places of a box, as high and as
/// low as there is terrain. A triangle that reaches far beyond the boxes that it meets may be allowed less,
/// so whoever takes a cut of what was read has to see whether all of it is fine enough (readForExtract()).
/// `outline`: of the model, its root at least. O(root triangles); of what comes back O(1).
RequiredError requiredInView(const ViewError& view, const TerrainModel& outline);

}  // namespace arete
