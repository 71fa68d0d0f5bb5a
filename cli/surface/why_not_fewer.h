// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/parallel/run_context.h"
#include "surface/front/model_components.h"
#include "surface/model/surface_model.h"

namespace arete {

/// seamsOf() a model, whose build can leave attributes out.
std::string seamsOfModel(const SurfaceModel& model);

/// What keeps the coarsest surface from having fewer triangles, as a part of a sentence: "1 component, 3
/// borders, seams".
/// @param dropped components that are left out; null: none.
std::string whyNotFewer(const SurfaceModel& model, const DroppedComponents* dropped,
                        const RunContext& context);

}  // namespace arete
