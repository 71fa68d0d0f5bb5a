// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "engine/base/result.h"
#include "engine/mt/multitriangulation.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// Every index of an MT's arrays in range, every link, floor, remover and creator as MtArrays states them,
/// spheres that hold their children's, every coordinate finite: after this every cut is closed and its front
/// whole, and no algorithm of the engine reads outside the arrays, whatever they hold. gridSamples: of the
/// raster that vertices are samples of. Precondition: the arrays have the sizes stated in MtArrays. The first
/// culprit is named, by the chunk of the file that holds it (io/format/layout.h), the same for any number of
/// threads. Errors: corrupt, interrupted. O(triangles), parallel.
Status checkMtIndices(const MultiTriangulation& mt, std::uint64_t gridSamples,
                      const RunContext& context = {});

}  // namespace arete
