// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/store/amt/file.h"
#include "surface/model/surface_model.h"

namespace arete {

/// The .amt file of a surface: format version 3 (docs/topics/amt-format.md). As of terrain, a file is written
/// whole from a model in memory and read by mapping it: the arrays of the multitriangulation lie in the file;
/// what is beside it is copied. A packed file is unpacked, and one in pages is read in part.

/// How writeSurfaceAmt() writes.
struct SurfaceWriteOptions {
  std::string writer = {};  ///< names the program in the file; empty = "Arete" and its version
  bool isPacked = false;    ///< compressed: see io/store/packed/packed.h for what changes
  bool isPaged = false;     ///< compressed, in pages that are read one by one
  int positionBits = 0;     ///< of a packed file: see SurfacePackOptions
};

/// Writes the model. The same model and options give the same bytes. Errors: as writeAmt(), those of
/// SurfaceModel::validate(), and of packSurfaceMt(); invalidData: positionBits move places of a model with
/// displacements, which are certain of the places before (roundSurface()).
Status writeSurfaceAmt(const std::string& path, const SurfaceModel& model, const RunContext& context = {},
                       const SurfaceWriteOptions& options = {});

/// The model as it is read from a packed file with rounded places: in another order, with larger errors, and
/// without its displacements where rounding moved any place. Rounding it again moves nothing. Errors: those
/// of packSurfaceMt().
Result<SurfaceModel> roundSurface(const SurfaceModel& model, int positionBits,
                                  const RunContext& context = {});

/// Reads a file and checks checksums, indices and sizes as `verify` says. Of a file in pages a part can be
/// required, whose boxes are in the coordinates of the model: it has a root and is a model in itself, whose
/// cuts say what they miss (Cut::missing), and SurfaceModel says what differs; any other file is read whole.
/// Errors: as openAmt(), and what the checks find; unsupported: the file is of terrain.
Result<SurfaceModel> loadSurfaceAmt(const std::string& path, const AmtReadOptions& options = {},
                                    const RunContext& context = {});
/// The same of what is open.
Result<SurfaceModel> loadSurfaceAmt(const AmtContainer& container, const AmtReadOptions& options = {},
                                    const RunContext& context = {});

/// What the metadata of a surface's file says.
struct SurfaceFacts {
  std::uint64_t vertices = 0;  ///< of the whole model
  AmtSummary summary;          ///< of a file in pages
};
/// Errors: as openAmt().
Result<SurfaceFacts> surfaceFacts(const AmtContainer& container);

/// As AmtFile::errorBeyond(), of a file in pages. Errors: as openAmt().
Result<double> surfaceErrorBeyond(const AmtContainer& container, std::uint64_t nodes);

/// As AmtFile::pagesFor(). Errors: as there, and as openAmt().
Result<std::vector<PageNeed>> surfacePagesFor(const AmtContainer& container, const RequiredError& wanted,
                                              const RunContext& context = {});

}  // namespace arete
