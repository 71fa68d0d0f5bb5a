// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "io/query/extract/model.h"
#include "io/query/source/source.h"

namespace arete {

/// Whether a path names a model that is built already: a file that begins as one, or whose name ends in .amt.
bool isModelFile(const std::string& path);

struct AnyModel {
  Model model;
  bool isBuilt = false;  ///< of a DEM or a mesh, in memory
  Warnings warnings = {};
};

/// Opens a model (openModel()), or reads a DEM, points or a mesh (readSource()) and builds the model of it
/// that `arete build` builds by default. Writes no file.
///
/// Errors: as openModel(), readSource(), buildTerrain() and buildSurfaceModel(); interrupted. As a
/// build takes, some microseconds a sample.
Result<AnyModel> openAnyModel(const std::string& path, const SourceOptions& options = {},
                              const RunContext& context = {});

}  // namespace arete
