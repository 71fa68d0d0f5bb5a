// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "engine/base/result.h"
#include "engine/base/vec.h"

namespace arete {

/// A camera as a user states it for a surface, in the file's unit.
struct SurfaceCamera {
  Vec3 eye, target;                   ///< different
  std::optional<double> fieldOfView;  ///< vertical, in degrees
};

/// Parses "x,y,z,tx,ty,tz[,FOV]". Errors: usage, naming the option.
Result<SurfaceCamera> readSurfaceCamera(const std::string& text);

}  // namespace arete
