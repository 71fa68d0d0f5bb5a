// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "cli/arguments/criterion.h"
#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/query/surface/criterion.h"
#include "surface/model/surface_model.h"

namespace arete {

/// What a user asks of a surface.
///
/// --region x0,y0,z0,x1,y1,z1 is a box, x,y,z,r a ball, a file's name a closed mesh; --camera
/// x,y,z,tx,ty,tz[,FOV] an eye, what it looks at and its vertical field of view in degrees: all in the file's
/// unit.
///
/// @param maxError the distance allowed, in the region if there is one; missing with a camera or a budget
/// alone.
/// @param maxTriangles the budget; missing: none.
/// Errors: usage, naming the option; those of reading the mesh of a region; invalidData: it is not closed.
Result<SurfaceCriterion> readSurfaceCriterion(const CriterionArguments::OfSurface& asked,
                                              std::optional<double> maxError,
                                              std::optional<std::uint32_t> maxTriangles,
                                              const SurfaceModel& model, const RunContext& context = {});

}  // namespace arete
