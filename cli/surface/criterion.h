// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli/arguments/criterion.h"
#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/query/request/criterion.h"
#include "surface/model/surface_model.h"

namespace arete {

/// What a user asks of a surface, but for --max-error and --max-triangles, of which there may be several.
///
/// --region x0,y0,z0,x1,y1,z1 is a box, x,y,z,r a ball, a file's name a closed mesh; --camera
/// x,y,z,tx,ty,tz[,FOV] an eye, what it looks at and its vertical field of view in degrees; --focus x,y,z a
/// place: all in the file's unit.
///
/// Errors: usage, naming the option; those of reading the mesh of a region; invalidData: it is not closed.
Result<CutRequest> readSurfaceRequest(const CriterionArguments::OfSurface& asked, const SurfaceModel& model,
                                      const RunContext& context = {});

/// Checks a request with its numbers. Errors: usage, naming the option.
Status checkSurfaceRequest(const CutRequest& request, const CriterionArguments::OfSurface& asked,
                           const SurfaceModel& model);

}  // namespace arete
