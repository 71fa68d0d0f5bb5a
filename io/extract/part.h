// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/amt/file.h"
#include "io/extract/tin.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// The model of a file, as far as these requests can ask for it: their TINs are those of the whole, but
/// that a camera's minimal cut of a packed file may have other triangles, a few less as a rule and all fine
/// enough: it asks about balls around what comes after a node, and of a packed file these hold what was
/// read. Where a format rounds heights it is enough for a tolerance that is smaller by
/// TinExtractor::kReadReserve of it. Everything, where a TIN is measured against all samples, a deadline
/// alone decides, a fit looks at all samples, or a saturated cut asks a packed file by place. `outline`: of
/// the file, its root at least. Errors: usage; those of AmtFile::read().
Result<TerrainModel> readForExtract(const AmtFile& file, std::span<const ExtractRequest> requests,
                                    const TerrainModel& outline, const RunContext& context = {});

}  // namespace arete
