// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/criteria/view_error.h"
#include "io/store/format/required_error.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// The error that a view probably requires of a model: the error that it allows inside a box of the plan,
/// between the lowest and the highest terrain. A triangle that reaches far beyond a box may be allowed less,
/// so a cut of the part that is read must be checked (readForExtract()).
/// @param outline  a part of the model, its root at least
/// O(root triangles); O(1) for a call of the result.
RequiredError requiredInView(const ViewError& view, const TerrainModel& outline);

}  // namespace arete
