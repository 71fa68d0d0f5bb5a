// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <variant>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/store/amt/container.h"
#include "surface/model/surface_model.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// What an .amt file holds.
using Model = std::variant<TerrainModel, SurfaceModel>;

/// Opens a file (openModelFile()) and reads all of it. Of a plain file of terrain, what no question touches
/// is not read into memory. Errors, naming the path: as openModelFile(), AmtFile::read() and
/// loadSurfaceAmt(). O(size)
Result<Model> openModel(const std::string& path, const AmtOpenOptions& options = {},
                        const RunContext& context = {});
/// The same of a file that is open.
Result<Model> readModel(AmtContainer file, const RunContext& context = {});

}  // namespace arete
