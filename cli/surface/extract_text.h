// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "io/query/surface/extractor.h"

namespace arete {

/// What `arete extract` prints of a surface that it wrote.
/// @param statesShare the budget was stated as a share of the finest triangles
std::string extractText(const ExtractRequest& request, const ExtractedSurface& found,
                        const SurfaceModel& model, bool statesShare);

/// The sentence of a tolerance that rounding did not let the cut keep everywhere.
std::string leftByRoundingText(const ExtractRequest& request, const ExtractedSurface& found,
                               const SurfaceModel& model);

/// The command that checks an export of a surface, for its certificate: `arete measure` against the model,
/// behind an `arete extract` of the source where components are left out. File names are quoted for a shell.
/// @param samples that the certificate's measurement took
std::string surfaceCheckCommand(const ExtractRequest& request, const std::string& modelPath,
                                double promisedError, std::uint64_t samples);

}  // namespace arete
