// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cli/mesh/mesh_input.h"
#include "cli/session/session.h"
#include "engine/base/result.h"
#include "surface/model/surface_model.h"

namespace arete {

struct SurfaceBuildArguments {
  std::string input, output;
  SurfaceBuildOptions options;
  bool isPacked = false;
  int positionBits = 0;
  bool isDisplaced = false;
};

/// `arete build` of a mesh with faces: builds, writes, reports. Errors: those of buildSurface() and
/// writeSurfaceAmt().
Status buildSurfaceFile(const SurfaceBuildArguments& arguments, MeshInput input, double secondsToRead,
                        Session& session);

}  // namespace arete
