// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/amt/file.h"
#include "surface/model/surface_model.h"

namespace arete {

/// The .amt file of a surface: format version 3 (docs/topics/amt-format.md). As of terrain, a file is written
/// whole from a model in memory and read by mapping it: the arrays of the multitriangulation lie in the file;
/// what is beside it is copied.

/// Writes the model. The same model and writer give the same bytes. Errors: as writeAmt(), and those of
/// SurfaceModel::validate().
Status writeSurfaceAmt(const std::string& path, const SurfaceModel& model, const RunContext& context = {},
                       const AmtWriteOptions& options = {});

/// Whether a file holds a surface. Errors: those of AmtContainer::open(). O(1).
Result<bool> isSurfaceAmt(const std::string& path);

/// Reads a file and checks checksums, indices and sizes as `verify` says. Errors: those of openAmt() and of
/// the checks; unsupported: the file is of terrain.
Result<SurfaceModel> loadSurfaceAmt(const std::string& path, AmtVerify verify = AmtVerify::all,
                                    const RunContext& context = {});

}  // namespace arete
