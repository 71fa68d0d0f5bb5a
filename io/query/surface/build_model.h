// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "io/query/surface/mesh_input.h"
#include "surface/model/surface_model.h"

namespace arete {

/// How the model of a mesh file is built.
struct SurfaceFileOptions {
  SurfaceBuildOptions build;
  bool isDisplaced = false;  ///< a direction for every vertex is found (surface/displacement)
  std::vector<std::string> dropAttributes = {};  ///< names that dropAttributes() leaves out first
};

struct BuiltSurface {
  SurfaceModel model;
  Warnings warnings;  ///< about pictures that are left out
  double secondsToBuild = 0, secondsToDisplace = 0;
};

/// Builds the model of a mesh as a file has it: with the file's numbers of vertices, its CRS, and the
/// pictures that its materials name, so that the model is whole without them.
/// @param source the file's name; begins the culprit of errors
/// Errors: those of dropAttributes(), buildSurface() and findDisplacement().
Result<BuiltSurface> buildSurfaceModel(MeshInput input, const std::string& source,
                                       const SurfaceFileOptions& options, const RunContext& context);

}  // namespace arete
