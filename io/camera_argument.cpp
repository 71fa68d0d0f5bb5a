// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/camera_argument.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/position_argument.h"

namespace arete {

Result<CameraArgument> readCameraArgument(const std::string& option, const std::string& text,
                                          const CrsTransform& toDem, const SurfaceHeights& heights) {
  const std::string culprit = fmt::format("{} {}", option, text);
  const auto commas = std::ranges::count(text, ',');
  if (commas != 2 && commas != 4 && commas != 5)
    return failure(ErrorCode::usage,
                   fmt::format("a camera is X,Y,H with agl, msl or ell behind H, then AZIMUTH,PITCH or "
                               "AZIMUTH,PITCH,FOV or nothing, not {} fields",
                               commas + 1),
                   culprit);
  // The position ends at the third comma.
  std::size_t end = text.find(',', text.find(',', text.find(',') + 1) + 1);
  const auto position = readPositionArgument(option, text.substr(0, end), toDem);
  if (!position) return failure(position.error().code, position.error().message, culprit);
  const auto height = demHeight(*position, heights);
  if (!height) return failure(height.error().code, height.error().message, culprit);

  CameraArgument argument;
  argument.positionText = text.substr(0, end);
  Camera& camera = argument.camera;
  camera.xy = position->xy;
  camera.height = *height;
  argument.statesLook = commas >= 4;
  argument.statesFieldOfView = commas == 5;
  for (double* to : {&camera.azimuthDegrees, &camera.pitchDegrees, &camera.verticalFieldOfViewDegrees}) {
    if (end == std::string::npos) break;
    const std::size_t begin = end + 1;
    end = text.find(',', begin);
    const auto number = readNumberText(std::string_view(text).substr(begin, end - begin));
    if (!number) return failure(number.error().code, number.error().message, culprit);
    *to = *number;
  }
  if (const auto view = viewOf(camera, heights.model()); !view)
    return failure(view.error().code, view.error().message, culprit);
  return argument;
}

std::string cameraText(const Camera& camera, const Georeference& dem) {
  return fmt::format(
      "{},{},{}{},{},{},{}", camera.xy.x, camera.xy.y, camera.height,
      toString(dem.verticalDatum == "ellipsoid" ? HeightKind::ellipsoidal : HeightKind::seaLevel),
      camera.azimuthDegrees, camera.pitchDegrees, camera.verticalFieldOfViewDegrees);
}

}  // namespace arete
