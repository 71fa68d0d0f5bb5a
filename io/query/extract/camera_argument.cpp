// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/extract/camera_argument.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "engine/base/caught_failure.h"
#include "engine/base/counted.h"
#include "io/geo/crs/data_unit.h"
#include "io/geo/crs/position_argument.h"

namespace arete {
namespace {

struct StatedCamera {
  std::string positionText;  ///< X,Y,H
  PositionArgument position;
  std::string_view behind;  ///< nothing, or a comma and the rest
  int fields = 0;
};

/// Precondition: the text outlives it.
Result<StatedCamera> stated(const std::string& option, const std::string& text, const CrsTransform& toDem,
                            const DataUnit& unit) {
  const std::string culprit = fmt::format("{} {}", option, text);
  const auto fields = static_cast<int>(std::ranges::count(text, ',')) + 1;
  if (fields != 3 && fields != 5 && fields != 6)
    return failure(ErrorCode::usage,
                   fmt::format("a camera is X,Y,H with agl, msl or ell behind H, then AZIMUTH,PITCH or "
                               "AZIMUTH,PITCH,FOV or nothing, not {}",
                               counted(std::size_t(fields), "field", "fields")),
                   culprit);
  // The position ends at the third comma.
  const std::size_t end = std::min(text.find(',', text.find(',', text.find(',') + 1) + 1), text.size());
  const auto position = readPositionArgument(option, text.substr(0, end), toDem, &unit);
  if (!position) return failure(position.error().code, position.error().message, culprit);
  return StatedCamera{text.substr(0, end), *position, std::string_view(text).substr(end), fields};
}

}  // namespace

Result<Vec2> readCameraPlace(const std::string& option, const std::string& text,
                             const CrsTransform& toDem) try {
  // Of a height only that it is one matters, so any unit does.
  return stated(option, text, toDem, DataUnit{1}).map([](const StatedCamera& camera) {
    return camera.position.xy;
  });
} catch (...) {
  return caughtFailure();
}

Result<CameraArgument> readCameraArgument(const std::string& option, const std::string& text,
                                          const CrsTransform& toDem, const GroundHeights& heights) try {
  const std::string culprit = fmt::format("{} {}", option, text);
  ARETE_TRY(const auto parts, stated(option, text, toDem, heightUnitOf(heights.model().georeference)));
  const auto height = demHeight(parts.position, heights);
  if (!height) return failure(height.error().code, height.error().message, culprit);

  CameraArgument argument;
  argument.positionText = parts.positionText;
  Camera& camera = argument.camera;
  camera.xy = parts.position.xy;
  camera.height = *height;
  argument.statesLook = parts.fields >= 5;
  argument.statesFieldOfView = parts.fields == 6;
  std::string_view behind = parts.behind;
  for (double* to : {&camera.azimuthDegrees, &camera.pitchDegrees, &camera.verticalFieldOfViewDegrees}) {
    if (behind.empty()) break;
    behind.remove_prefix(1);
    const std::string_view field = behind.substr(0, behind.find(','));
    const auto number = readNumberText(field);
    if (!number) return failure(number.error().code, number.error().message, culprit);
    *to = *number;
    behind.remove_prefix(field.size());
  }
  if (const auto view = viewOf(camera, heights.model()); !view)
    return failure(view.error().code, view.error().message, culprit);
  return argument;
} catch (...) {
  return caughtFailure();
}

std::string cameraText(const Camera& camera, const Georeference& dem) {
  return fmt::format(
      "{},{},{}{},{},{},{}", camera.xy.x, camera.xy.y, camera.height,
      toString(dem.verticalDatum == "ellipsoid" ? HeightKind::ellipsoidal : HeightKind::seaLevel),
      camera.azimuthDegrees, camera.pitchDegrees, camera.verticalFieldOfViewDegrees);
}

}  // namespace arete
