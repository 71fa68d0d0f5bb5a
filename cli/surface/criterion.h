// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "cli/arguments/criterion.h"
#include "engine/base/result.h"
#include "engine/criteria/criterion.h"
#include "engine/parallel/run_context.h"
#include "surface/model/surface_model.h"

namespace arete {

/// The criterion that a user states for a surface.
///
/// --region x0,y0,z0,x1,y1,z1 is a box, x,y,z,r a ball, a file's name a closed mesh; --camera
/// x,y,z,tx,ty,tz[,FOV] an eye, what it looks at and its vertical field of view in degrees: all in the file's
/// unit.
///
/// @param maxError the distance allowed, in the region if there is one; missing with a camera or a budget.
/// Errors: usage, naming the option; those of reading the mesh of a region; invalidData: it is not closed.
Result<std::unique_ptr<const Criterion>> surfaceCriterion(const CriterionArguments::OfSurface& asked,
                                                          std::optional<double> maxError,
                                                          const SurfaceModel& model,
                                                          const RunContext& context = {});

}  // namespace arete
