// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "engine/result.h"
#include "engine/run_context.h"
#include "io/amt_file.h"
#include "io/extract_tin.h"
#include "terrain/terrain_model.h"

namespace arete {

/// The model of a file, as far as these requests can ask for it: their TINs are those of the whole, but that
/// a camera's of a packed file may have a few triangles less, all of them fine enough, as the balls that it
/// is asked about are of what was read. Everything, where a TIN is measured against all samples, or its
/// format rounds heights and so may want a smaller error than the one asked for; where a camera has a budget,
/// or a deadline alone decides; where a fit looks at all samples, or a saturated cut at balls around all
/// descendants (wantedBy()). `outline`: of the file, its root at least. Errors: usage; those of
/// AmtFile::read().
Result<TerrainModel> readForExtract(const AmtFile& file, std::span<const ExtractRequest> requests,
                                    const TerrainModel& outline, const RunContext& context = {});

}  // namespace arete
