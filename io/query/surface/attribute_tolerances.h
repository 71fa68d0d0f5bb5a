// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "engine/base/result.h"
#include "surface/attributes/attribute_names.h"
#include "surface/front/attribute_criterion.h"
#include "surface/model/surface_model.h"

namespace arete {

/// The tolerances that a request states, in the units of the model's errors. Pixels are of the largest
/// picture of the materials, so that in every picture they are at most as many. Materials, objects and labels
/// of faces are parts, whose edges are lines of every cut: any tolerance of them is kept.
///
/// Errors: usage, culprit "attributeErrors" and the name: the model's attributes are not bounded, a group or
/// an averaged number of faces, which cuts do not keep, no attribute of that name, pixels of what is not of
/// texture coordinates, or no picture can be read.
Result<std::vector<AttributeTolerance>> attributeTolerances(const SurfaceModel& model,
                                                            std::span<const AttributeNumber> asked);

/// What a cut states of the model's bounded attributes, with the unit of AttributeDistance; infinite: not
/// bounded. O(front * attributes).
std::vector<AttributeNumber> statedAttributeErrors(const SurfaceModel& model, const StatedAttributes& stated);

}  // namespace arete
