// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/query/request/extract_request.h"
#include "io/store/amt/surface_file.h"
#include "surface/model/surface_model.h"

namespace arete {

/// What a file says of a surface, with its root at least: of pages nothing more is read, any other file is
/// read whole. Errors: as loadSurfaceAmt().
Result<SurfaceModel> readOutline(const AmtContainer& file, const RunContext& context = {});

/// Reads the part of a surface's file that requests need. The whole file gives the same meshes, with one
/// exception, as for terrain: the minimal cut by region, focus or camera may have a few more triangles, since
/// the balls of nodes whose descendants were not read are larger. A part is returned where the cuts of it
/// miss nothing (Cut::missing). The whole file is read where it is not in pages, where the source is
/// measured, numbered or fitted to, where components are left out or an importance is asked for, where a
/// deadline ends the cut, and for a saturated cut by place.
///
/// @param outline readOutline(); the result where that is everything
/// Errors: as loadSurfaceAmt(); interrupted. O(part), and its cuts.
Result<SurfaceModel> readForExtract(const AmtContainer& file, std::span<const ExtractRequest> requests,
                                    SurfaceModel outline, const RunContext& context = {});

}  // namespace arete
