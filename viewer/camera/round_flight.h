// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "engine/base/result.h"
#include "terrain/locate/ground_height.h"
#include "viewer/camera/flight.h"
#include "viewer/camera/home_view.h"

namespace arete {

struct RoundFlightOptions {
  double heightAboveGround = 0;  ///< metres, at least so high everywhere; 0 chooses by the terrain's size
  double durationSeconds = 60;   ///< once around
  double pitchDegrees = -15;
  double inwardDegrees = 20;  ///< how far the camera looks inwards from straight ahead
  std::size_t keys = 24;      ///< at least 4
};

/// A closed flight around the inside of a terrain, clockwise on the map, for those who have none: along an
/// ellipse half as wide and as long as the box, so high that nothing of the terrain below the path comes
/// nearer than stated (checked every sixty-fourth of a leg). Over NODATA the last ground counts. Errors:
/// usage, numbers that make no sense. O(keys * height query).
Result<FlightPlan> roundFlight(const GroundHeights& heights, const CameraSpace& space, const MetricBox& box,
                               const RoundFlightOptions& options = {});

/// A closed flight once around the vertical through a place, anticlockwise on the map, from a camera on: with
/// its distance, its height and, as it is turned with it, its view of the place. A camera above the place
/// turns on the spot. Errors: as Flight::create(). O(1).
Result<FlightPlan> turnAround(const CameraSpace& space, const Vec3& middle, const Camera& from,
                              double durationSeconds = 8);

}  // namespace arete
