// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/store/amt/surface_file.h"

namespace arete {

/// As writeSurfaceAmt(), and where options round the places of a model with displacements, finds these again
/// for the rounded places. Errors: those of writeSurfaceAmt(), roundSurface() and findDisplacement(); the
/// culprit is the path.
Status writeSurfaceModel(const std::string& path, const SurfaceModel& model, const RunContext& context = {},
                         const SurfaceWriteOptions& options = {});

}  // namespace arete
