// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "io/geo/crs/transform.h"
#include "terrain/locate/ground_height.h"
#include "terrain/model/camera.h"

namespace arete {

/// A camera as a person stated it.
struct CameraArgument {
  Camera camera;
  std::string positionText;                            ///< "X,Y,H" as stated
  bool statesLook = false, statesFieldOfView = false;  ///< otherwise they are the defaults of Camera
};

/// Reads a camera: a position (io/geo/crs/position_argument.h), optionally followed by its direction and its
/// vertical field of view in degrees: "X,Y,H", "X,Y,H,AZIMUTH,PITCH" or "X,Y,H,AZIMUTH,PITCH,FOV", with agl,
/// msl or ell behind H.
/// @param option   what the text belongs to; begins the culprit of errors
/// @param toDem    from the coordinates of the text to those of the DEM
/// @param heights  the terrain, for heights above ground
/// Errors: usage; invalidData: a height above ground where there is no terrain.
Result<CameraArgument> readCameraArgument(const std::string& option, const std::string& text,
                                          const CrsTransform& toDem, const GroundHeights& heights);

/// The position of such a camera in the DEM's CRS, so that the terrain below it can be read before
/// readCameraArgument(). Errors: usage.
Result<Vec2> readCameraPlace(const std::string& option, const std::string& text, const CrsTransform& toDem);

/// The text, in the DEM's coordinates, that readCameraArgument() reads back to the same camera, to the bit.
/// It does not include the size of the picture. Precondition: azimuth and pitch are finite.
std::string cameraText(const Camera& camera, const Georeference& dem);

}  // namespace arete
