// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/result.h"
#include "engine/criteria/view.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// A camera as a person states it.
struct Camera {
  Vec2 xy = {};               ///< source coordinates
  double height = 0;          ///< as the DEM's heights: its vertical unit and datum
  double azimuthDegrees = 0;  ///< clockwise from the map's north (the y axis of the source)
  double pitchDegrees = 0;    ///< above the horizon; -90 looks straight down
  double verticalFieldOfViewDegrees = 60;
  double widthPixels = 1920, heightPixels = 1080;
};

/// The camera in the metric space of the model's MT, where ViewError wants it. Lengths there are metres
/// (source units without a CRS) and the Earth is flat; on a geographic CRS both are true in the middle of the
/// DEM. Errors: usage, naming the number that makes no sense.
Result<View> viewOf(const Camera& camera, const TerrainModel& model);

/// A place of the map in that space.
Vec3 metricPosition(Vec2 xy, double height, const TerrainModel& model);

}  // namespace arete
