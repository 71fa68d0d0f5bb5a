// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/camera/round_flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "viewer/camera_models.h"

namespace arete {
namespace {

/// The least height of a flight above the ground in metres, over many looks at even times; infinite where
/// there is no terrain under any of them.
double leastHeightAboveGround(const Flight& flight, const GroundHeights& heights, const CameraSpace& space) {
  constexpr int kLooks = 10000;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kLooks; ++i) {
    const Camera camera = flight.at(flight.duration() * i / kLooks);
    if (const auto ground = heights.at(camera.xy))
      least = std::min(least, (camera.height - ground->height) * space.metresPerHeight());
  }
  return least;
}

TEST(RoundFlight, StaysAboveTheGroundInsideTheBoxOnEveryTerrain) {
  for (const RasterFamily& family : rasterFamilies())
    for (const auto& g : {std::array<double, 6>{500000, 30, 0, 4000000, 0, -30},
                          std::array<double, 6>{500000, 25, 12, 4000000, 9, -22}}) {
      SCOPED_TRACE(std::string(family.name) + ", seed 7");
      const TerrainModel model = test::modelOn(family, g);
      const CameraSpace space(model);
      const GroundHeights heights(model);
      const MetricBox box = metricBox(model);
      const auto plan = roundFlight(heights, space, box, {.heightAboveGround = 40, .durationSeconds = 30});
      ASSERT_TRUE(plan) << plan.error().describe();
      const auto flight = Flight::create(*plan, space);
      ASSERT_TRUE(flight) << flight.error().describe();
      EXPECT_NEAR(flight->duration(), 30, 1e-6);
      // Between two looks of the making, less than a hundredth of a leg apart, the ground may rise a little.
      EXPECT_GE(leastHeightAboveGround(*flight, heights, space), 36);
      double clockwise = 0;
      for (int i = 0; i <= 200; ++i) {
        const Vec3 p = space.position(flight->at(30.0 * i / 200));
        EXPECT_TRUE(p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y);
        const Vec2 here = flight->at(30.0 * i / 200).xy, next = flight->at(30.0 * (i + 1) / 200).xy;
        const Vec2 centre = space.xy(box.centre());
        clockwise += (here.y - centre.y) * (next.x - centre.x) - (here.x - centre.x) * (next.y - centre.y);
      }
      EXPECT_GT(clockwise, 0);
    }
}

TEST(RoundFlight, LooksAlongItsWayAndInwards) {
  for (const auto& [name, model] : test::cameraModels()) {
    const CameraSpace space(model);
    const GroundHeights heights(model);
    const auto plan = roundFlight(heights, space, metricBox(model), {.inwardDegrees = 0});
    ASSERT_TRUE(plan) << name;
    const auto flight = Flight::create(*plan, space);
    ASSERT_TRUE(flight) << name;
    for (double t = 0; t < flight->duration(); t += 1.7) {
      const Vec3 p = space.position(flight->at(t)), q = space.position(flight->at(t + 0.01));
      const Look ahead = space.lookAlong({q.x - p.x, q.y - p.y, 0});
      EXPECT_LT(test::turned(ahead.azimuthDegrees, flight->at(t).azimuthDegrees), 6) << name << " at " << t;
    }
  }
}

TEST(RoundFlight, RefusesNumbersThatMakeNoSense) {
  const TerrainModel& model = test::cameraModels()[0].model;
  const CameraSpace space(model);
  const GroundHeights heights(model);
  const MetricBox box = metricBox(model);
  EXPECT_FALSE(roundFlight(heights, space, box, {.keys = 3}));
  EXPECT_FALSE(roundFlight(heights, space, box, {.durationSeconds = 0}));
  EXPECT_FALSE(roundFlight(heights, space, box, {.heightAboveGround = NAN}));
  EXPECT_FALSE(roundFlight(heights, space, box, {.pitchDegrees = 100}));
}

}  // namespace
}  // namespace arete
