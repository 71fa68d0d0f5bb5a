// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/surface/camera.h"

#include <fmt/format.h>

#include <vector>

#include "cli/arguments/arguments.h"

namespace arete {

Result<SurfaceCameraArgument> readSurfaceCamera(const std::string& text) {
  const std::string option = fmt::format("--camera {}", text);
  const Result<std::vector<double>> numbers = parseNumbers(option, text);
  if (!numbers || (numbers->size() != 6 && numbers->size() != 7))
    return failure(
        ErrorCode::usage,
        "the camera of a surface is x,y,z of the eye, x,y,z of what it looks at and perhaps a field "
        "of view in degrees",
        option);
  const std::vector<double>& n = *numbers;
  SurfaceCamera camera{.eye = {n[0], n[1], n[2]}, .target = {n[3], n[4], n[5]}};
  if (camera.eye == camera.target) return failure(ErrorCode::usage, "the eye is at what it looks at", option);
  if (n.size() == 7) camera.verticalFieldOfViewDegrees = n[6];
  return SurfaceCameraArgument{camera, n.size() == 7};
}

}  // namespace arete
