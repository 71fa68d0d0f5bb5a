// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/base/result.h"
#include "surface/model/camera.h"

namespace arete {

/// A camera as a user states it for a surface, in the file's unit.
struct SurfaceCameraArgument {
  SurfaceCamera camera;
  bool statesFieldOfView = false;  ///< otherwise it is the default of SurfaceCamera
};

/// Parses "x,y,z,tx,ty,tz[,FOV]". Errors: usage, naming the option.
Result<SurfaceCameraArgument> readSurfaceCamera(const std::string& text);

}  // namespace arete
