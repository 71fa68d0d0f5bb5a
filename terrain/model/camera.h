// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/result.h"
#include "engine/criteria/view.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// A camera in the terms of a map.
struct Camera {
  Vec2 xy = {};               ///< source coordinates
  double height = 0;          ///< in the DEM's vertical unit, above its datum
  double azimuthDegrees = 0;  ///< clockwise from the map's north (the y axis of the source)
  double pitchDegrees = 0;    ///< above the horizon; -90 looks straight down
  double verticalFieldOfViewDegrees = 60;
  double widthPixels = 1920, heightPixels = 1080;
  /// Above 0: a parallel projection, whose picture has this height in metric units; all that is within the
  /// sides of the picture is seen, behind the camera too. 0: perspective.
  double parallelHeight = 0;
};

/// Transforms a camera to the metric space of the model's multitriangulation, as ViewError takes it. Lengths
/// there are metres (source units without a CRS) and the Earth is flat; on a geographic CRS both are exact in
/// the middle of the DEM only. Errors: usage, culprit "camera": a number is out of range.
Result<View> viewOf(const Camera& camera, const TerrainModel& model);

/// A position of the map in that space.
/// @param xy  source coordinates
/// @param height  in the DEM's vertical unit
Vec3 metricPosition(Vec2 xy, double height, const TerrainModel& model);

}  // namespace arete
