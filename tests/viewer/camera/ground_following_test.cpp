// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/camera/ground_following.h"

#include <gtest/gtest.h>

#include "viewer/camera/free_camera.h"
#include "viewer/camera_models.h"

namespace arete {
namespace {

double heightAboveGround(const Camera& camera, const GroundHeights& heights) {
  const auto ground = heights.at(camera.xy);
  return ground ? (camera.height - ground->height) * CameraSpace(heights.model()).metresPerHeight()
                : INFINITY;
}

TEST(GroundFollowing, IsNeverBelowTheFloorWhateverTheTerrainAndTheWay) {
  for (const RasterFamily& family : rasterFamilies())
    for (const std::uint64_t seed : {11u, 12u}) {
      SCOPED_TRACE(std::string(family.name) + ", seed " + std::to_string(seed));
      const TerrainModel model =
          test::modelOn(family, {500000, 30, 8, 4000000, 4, -30}, false, seed == 11 ? 1 : 0.3048, seed);
      const CameraSpace space(model);
      const GroundHeights heights(model);
      GroundFollowing following(heights, space, {.floorMetres = 5, .maxError = 20});
      Random random(seed);
      FreeCamera camera(space, {.xy = model.toSource({20, 15}), .height = -1e4});
      following.begin(camera.camera());
      following.keep(random.between(0, 60));
      for (int frame = 0; frame < 1500; ++frame) {
        camera.turn(random.between(-8, 9), random.between(-5, 5));
        const double seconds = random.between(0.001, 0.1);
        camera.fly({.tangent = 400, .climb = random.between(-300, 300)}, seconds);
        camera.place(frame % 100 < 50 ? following.follow(camera.camera(), seconds)
                                      : following.aboveFloor(camera.camera()));
        ASSERT_GE(heightAboveGround(camera.camera(), heights), 5 - 1e-6) << "frame " << frame;
      }
    }
}

TEST(GroundFollowing, FollowsAHillSmoothlyAndComesBackToItsHeight) {
  // A ridge of 200 m across a plain, 40 m to a sample.
  RasterHeightfield field;
  field.columns = 200;
  field.rows = 20;
  for (std::uint32_t r = 0; r < field.rows; ++r)
    for (std::uint32_t c = 0; c < field.columns; ++c)
      field.heights.push_back(200 * std::exp(-std::pow((c - 100.0) / 12, 2)));
  field.georeference.geoTransform = {0, 40, 0, 0, 0, -40};
  const auto model = build(field);
  ASSERT_TRUE(model);
  const CameraSpace space(*model);
  const GroundHeights heights(*model);
  GroundFollowing following(heights, space, {.floorMetres = 10, .maxError = 0});
  Camera camera{.xy = {1000, -400}, .height = 80};
  following.begin(camera);
  EXPECT_NEAR(following.keptMetres(), 80, 1e-6);
  double climb = 0, hardest = 0, least = INFINITY;
  for (int frame = 0; frame < 60 * 40; ++frame) {
    camera.xy.x += 150.0 / 60;
    const Camera next = following.follow(camera, 1.0 / 60);
    const double rate = (next.height - camera.height) * 60;
    if (frame > 0) hardest = std::max(hardest, std::abs(rate - climb) * 60);
    climb = rate;
    camera = next;
    least = std::min(least, heightAboveGround(camera, heights));
  }
  EXPECT_GE(least, 60) << "it climbs before the slope is there";
  EXPECT_LE(hardest, 60) << "m/s^2: no jerk at 150 m/s";
  EXPECT_NEAR(heightAboveGround(camera, heights), 80, 0.01);
}

TEST(GroundFollowing, KeepsTheLastGroundOffTheTerrain) {
  const TerrainModel model = test::modelOn(rasterFamilies()[2], {0, 30, 0, 0, 0, -30});
  const CameraSpace space(model);
  const GroundHeights heights(model);
  GroundFollowing following(heights, space, {.floorMetres = 5, .maxError = 0});
  const Camera outside{.xy = {-500, 100}, .height = -1e6};
  EXPECT_EQ(following.aboveFloor(outside).height, -1e6) << "there was no ground yet";
  const Vec2 inside = model.toSource({20, 15});
  const Camera raised = following.aboveFloor({.xy = inside, .height = -1e6});
  EXPECT_NEAR(raised.height, heights.at(inside)->height + 5, 1e-6);
  EXPECT_NEAR(following.aboveFloor(outside).height, raised.height, 1e-6);
  const Camera high{.xy = inside, .height = 1e4};
  EXPECT_EQ(following.aboveFloor(high).height, 1e4) << "nothing is lowered";
}

}  // namespace
}  // namespace arete
