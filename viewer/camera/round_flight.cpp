// SPDX-License-Identifier: GPL-3.0-or-later
//
// The height of a flight between two keys stays between their heights (path_curve.h). So each key must be as
// high as the ground below both of its legs requires. The plan of the path depends a little on the heights of
// the keys, because its knots are spaced by distances in space: keys are raised until the whole path is high
// enough. Keys are never lowered and their heights are bounded by the ground, so this ends.
#include "viewer/camera/round_flight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace arete {
namespace {

constexpr std::size_t kLooksPerLeg = 64;
constexpr int kMostRounds = 20;

}  // namespace

Result<FlightPlan> roundFlight(const GroundHeights& heights, const CameraSpace& space, const MetricBox& box,
                               const RoundFlightOptions& options) {
  const std::size_t count = options.keys;
  const Vec3 centre = box.centre();
  const double halfX = (box.high.x - box.low.x) / 2, halfY = (box.high.y - box.low.y) / 2;
  if (count < 4 || count > 10000)
    return failure(ErrorCode::usage, "has 4 to 10000 key frames", "round flight");
  if (!(options.heightAboveGround >= 0 && std::isfinite(options.heightAboveGround)))
    return failure(ErrorCode::usage, "its height above ground must be 0 or more", "round flight");
  const double clearance =
      options.heightAboveGround > 0 ? options.heightAboveGround : std::min(halfX, halfY) / 8;

  // Along the axes of the plan, so that it is inside whichever way the grid is turned, and clockwise on the
  // map, whichever way metric space turns.
  const Vec3 north = space.forward({0, 0}), east = space.right(0);
  const double turn = east.x * north.y - east.y * north.x > 0 ? -1 : 1;
  const double a = halfX / 2, b = turn * halfY / 2;
  const auto ground = [&](const Vec3& p) {
    const auto found = heights.at(space.xy(p));
    return found ? space.position(space.xy(p), found->height).z : -std::numeric_limits<double>::infinity();
  };

  std::vector<Vec3> places(count + 1);
  FlightPlan plan;
  plan.isClosed = true;
  plan.duration = options.durationSeconds;
  for (std::size_t i = 0; i <= count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i % count) / static_cast<double>(count);
    places[i] = {centre.x + a * std::cos(angle), centre.y + b * std::sin(angle), box.low.z};
    if (i == count) break;
    const Look along = space.lookAlong({-a * std::sin(angle), b * std::cos(angle), 0});
    plan.keys.push_back({.azimuthDegrees = wrappedAzimuth(along.azimuthDegrees + options.inwardDegrees),
                         .pitchDegrees = options.pitchDegrees});
  }

  bool isHighEnough = false;
  for (int round = 0; round < kMostRounds && !isHighEnough; ++round) {
    const PathCurve path(places, true);
    const auto at = path.lengthsAtPoints();
    std::vector<double> asked(count, -std::numeric_limits<double>::infinity());
    for (std::size_t leg = 0; leg < count; ++leg)
      for (std::size_t look = 0; look <= kLooksPerLeg; ++look) {
        const double part = static_cast<double>(look) / kLooksPerLeg;
        const double z = ground(path.at(at[leg] + part * (at[leg + 1] - at[leg]))) + clearance;
        for (const std::size_t key : {leg, (leg + 1) % count}) asked[key] = std::max(asked[key], z);
      }
    // A key over no terrain takes the height of the one before.
    for (std::size_t i = 0; i < 2 * count; ++i)
      if (!std::isfinite(asked[i % count])) asked[i % count] = asked[(i + count - 1) % count];
    isHighEnough = true;
    for (std::size_t i = 0; i < count; ++i) {
      const double z = std::isfinite(asked[i]) ? asked[i] : box.high.z + clearance;
      if (z > places[i].z) {
        places[i].z = z;
        isHighEnough = false;
      }
    }
    places[count].z = places[0].z;
  }
  for (std::size_t i = 0; i < count; ++i) plan.keys[i] = space.at(plan.keys[i], places[i]);
  if (const auto flight = Flight::create(plan, space); !flight)
    return failure(flight.error().code, flight.error().message, "round flight");
  return plan;
}

// So many keys that between two of them the path leaves the circle by far less than a pixel.
Result<FlightPlan> turnAround(const CameraSpace& space, const Vec3& middle, const Camera& from,
                              double durationSeconds) {
  constexpr int kKeys = 72;
  FlightPlan plan;
  plan.duration = durationSeconds;
  plan.framesPerSecond = 30;
  const Vec3 away = space.position(from) - middle;
  plan.isClosed = std::hypot(away.x, away.y) > 1e-5 * norm(away);
  for (int i = 0; i < (plan.isClosed ? kKeys : kKeys + 1); ++i) {
    const double turn = 2 * std::numbers::pi * i / kKeys, c = std::cos(turn), s = std::sin(turn);
    const Vec3 place = plan.isClosed ? Vec3{away.x * c - away.y * s, away.x * s + away.y * c, away.z} : away;
    Camera key = space.at(from, middle + place);
    key.azimuthDegrees = wrappedAzimuth(from.azimuthDegrees - turn * 180 / std::numbers::pi);
    plan.keys.push_back(key);
  }
  ARETE_CHECK(Flight::create(plan, space));
  return plan;
}

}  // namespace arete
