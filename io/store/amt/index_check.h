// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "engine/base/result.h"
#include "engine/mt/multitriangulation.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// Checks that every index of an MT's arrays is in range, that links, floors, removers and creators are
/// related as engine/mt/multitriangulation.h states, that spheres contain those of their children, and that
/// every coordinate is finite. Then every cut is closed and its front conforming, and no algorithm of the
/// engine reads outside the arrays. Precondition: the arrays have the sizes stated there; their content is
/// arbitrary.
/// @param gridSamples  samples of the raster that the vertices belong to; not used for points
/// Errors: corrupt: the message names the first culprit and the chunk of the file that holds it
/// (io/store/format/layout.h), the same for any number of threads; interrupted. O(triangles), parallel.
Status checkMtIndices(const MultiTriangulation& mt, std::uint64_t gridSamples,
                      const RunContext& context = {});

}  // namespace arete
