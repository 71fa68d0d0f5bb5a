// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "engine/base/result.h"
#include "surface/front/importance.h"
#include "surface/model/surface_model.h"

namespace arete {

/// The importance that a request names, as options name attributes. Where vertices and corners have one of
/// that name, the larger counts. Nothing of an empty name.
/// Errors: usage, culprit "importance" and the name: the model lacks it, it has several numbers, or it is of
/// faces; as importanceOf(), with the same culprit.
Result<std::optional<Importance>> importanceNamed(const SurfaceModel& model, const std::string& name);

}  // namespace arete
