// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "cli/arguments/criterion.h"
#include "cli/arguments/extract_outputs.h"
#include "cli/session/session.h"
#include "engine/base/result.h"
#include "io/store/amt/container.h"
#include "surface/normals/made_normals.h"

namespace arete {

struct SurfaceExtractArguments {
  std::string model;
  ExtractOutputs outputs;
  CriterionArguments::OfSurface asked;
  std::string dropParts;  ///< --drop-parts; empty: none
  std::vector<std::string> dropAttributes = {};
  NormalsOptions normals = {};
  bool measuresBothWays = false;     ///< the distance from the result to the source, too
  std::string attributeErrors = {};  ///< --attribute-error; empty: none
  std::string importance = {};       ///< --importance; empty: none
  bool staysUndisplaced = false;     ///< vertices of a displaced model stay where they are in the source
};

/// `arete extract` of a surface: one mesh for each tolerance and each budget. Errors: as
/// loadSurfaceAmt() and SurfaceExtractor::extract(); usage, naming the option; a budget below the root's
/// triangles, with the least count and what forbids fewer; brokenPromise: a measurement contradicts what is
/// promised, once all files are written.
Status extractSurface(const SurfaceExtractArguments& arguments, const AmtContainer& file, Session& session);

}  // namespace arete
