// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "io/query/extract/tin.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// The options of `arete extract` that state a criterion, each with a space before it.
std::string optionsOf(const CutRequest& criterion);

/// The command that checks an export, for its certificate: `arete measure` with the options that the source
/// was read with, behind an `arete extract` where the export is not a mesh. File names are quoted for a
/// shell.
/// @param model          the model, or any part of it
/// @param modelPath      its file
/// @param promisedError  what `arete measure` is to expect
std::string checkCommand(const ExtractRequest& request, const TerrainModel& model,
                         const std::string& modelPath, double promisedError);

}  // namespace arete
