// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/fit/mesh.h"

namespace arete {

/// Removes leaves from the cut, by rising saturated error, as long as the heights around them can be changed
/// so that all samples are within their bounds; every intermediate state is within them too. The result is
/// the same for any number of threads. Precondition: all samples are within their bounds. Errors:
/// interrupted.
Status removeWhatFits(FitMesh& mesh, std::uint32_t rings, const RunContext& context);

/// Changes heights until patches of up to `rings` rings cannot reduce the largest |residual| by more than 0.5
/// %, or it is within FitBounds::rounding. Replaces the mesh's bounds by uniform ones. Errors: interrupted.
Status minimizeLargestError(FitMesh& mesh, std::uint32_t rings, const RunContext& context);

/// Changes heights until the mean residual is 0, on the whole and in the parts of the ground, as far as the
/// bounds permit; every intermediate state is within them. The result is the same for any number of threads.
/// Precondition: all samples are within their bounds. Errors: interrupted.
Status removeMeanErrors(FitMesh& mesh, const RunContext& context);

}  // namespace arete
