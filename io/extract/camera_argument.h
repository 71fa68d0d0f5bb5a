// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "io/crs/transform.h"
#include "terrain/locate/surface_height.h"
#include "terrain/model/camera.h"

namespace arete {

/// What a person said of a camera.
struct CameraArgument {
  Camera camera;
  std::string positionText;                            ///< X,Y,H as it was given
  bool statesLook = false, statesFieldOfView = false;  ///< else they are what Camera has by itself
};

/// A camera as a person states it, above its terrain: a position (io/crs/position_argument.h), and behind it,
/// on request, where it looks and its vertical field of view in degrees: "X,Y,H", "X,Y,H,AZIMUTH,PITCH" or
/// "X,Y,H,AZIMUTH,PITCH,FOV", agl, msl or ell behind H. `option` is named in errors. Errors: usage;
/// invalidData, a height above ground above no terrain.
Result<CameraArgument> readCameraArgument(const std::string& option, const std::string& text,
                                          const CrsTransform& toDem, const SurfaceHeights& heights);

/// Where such a camera stands, in the DEM's CRS: below it is what of the terrain a height above ground is
/// counted from. Errors: usage.
Result<Vec2> readCameraPlace(const std::string& option, const std::string& text, const CrsTransform& toDem);

/// The text in the DEM's own coordinates that reads back to the camera, to the bit; its picture size is none
/// of it. An azimuth or pitch that is not finite has no such text.
std::string cameraText(const Camera& camera, const Georeference& dem);

}  // namespace arete
