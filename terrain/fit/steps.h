// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/fit/mesh.h"

namespace arete {

/// Takes leaves out of the cut, by rising saturated error, as long as the vertices around them can be moved
/// so that all samples are within their bounds. Every state between is within them. The same for any number
/// of threads. Errors: interrupted. Precondition: all samples are within their bounds.
Status removeWhatFits(FitMesh& mesh, std::uint32_t rings, const RunContext& context);

/// Moves heights until the largest |residual| is as small as patches of up to `rings` rings can make it,
/// within half a hundredth of it, or within the rounding that its bounds state. Leaves uniform bounds behind.
/// Errors: interrupted.
Status lessenWorst(FitMesh& mesh, std::uint32_t rings, const RunContext& context);

}  // namespace arete
