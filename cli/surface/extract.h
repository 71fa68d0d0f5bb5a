// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "cli/arguments/criterion.h"
#include "cli/session/session.h"
#include "engine/base/result.h"
#include "io/files/existing_file.h"
#include "io/store/amt/container.h"

namespace arete {

struct SurfaceExtractArguments {
  std::string model;
  std::string output, format;  ///< as MeshOutput; {} in the name becomes the tolerance
  CriterionArguments::OfSurface asked;
  std::string map;        ///< --map; empty: none
  std::string dropParts;  ///< --drop-parts; empty: none
  std::vector<std::string> dropAttributes = {};
  bool isBothWays = false;     ///< the distance from the result to the source, too
  bool isUndisplaced = false;  ///< vertices of a displaced model stay where they are in the source
  ExistingFile existing = ExistingFile::keepsOtherLayers;
};

/// `arete extract` of a surface: one mesh for each tolerance, or the one of a budget. Errors: those of
/// loadSurfaceAmt(), takeCut(), writeMesh(); usage, naming the option; a budget below the root's triangles,
/// with the least count and what forbids fewer.
Status extractSurface(const SurfaceExtractArguments& arguments, const AmtContainer& file, Session& session);

}  // namespace arete
