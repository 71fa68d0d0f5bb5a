// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/extract/camera_argument.h"

#include <gtest/gtest.h>

#include "datasets/families.h"
#include "datasets/random.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

/// z = 100 + x on 0..4 x 0..4, x to the right, y down.
const TerrainModel& slope() {
  static const TerrainModel model = [] {
    RasterHeightfield field;
    field.columns = field.rows = 5;
    for (int i = 0; i < 25; ++i) field.heights.push_back(100 + i % 5);
    field.georeference.geoTransform = {-0.5, 1, 0, -0.5, 0, 1};
    return build(field).value();
  }();
  return model;
}

TEST(CameraArgument, TakesAPositionAndOnRequestALookAndAField) {
  const GroundHeights heights(slope());
  const auto place = readCameraArgument("--camera", "1.5,2,10", {}, heights);
  ASSERT_TRUE(place) << place.error().describe();
  EXPECT_NEAR(place->camera.height, 111.5, 1e-9) << "above ground unless it says otherwise";
  EXPECT_FALSE(place->statesLook || place->statesFieldOfView);
  EXPECT_EQ(place->camera.pitchDegrees, 0);

  const auto look = readCameraArgument("--camera", "1.5,2,300msl, 45 ,-10", {}, heights);
  ASSERT_TRUE(look) << look.error().describe();
  EXPECT_EQ(look->camera.xy, (Vec2{1.5, 2}));
  EXPECT_EQ(look->camera.height, 300);
  EXPECT_EQ(look->camera.azimuthDegrees, 45);
  EXPECT_EQ(look->camera.pitchDegrees, -10);
  EXPECT_EQ(look->camera.verticalFieldOfViewDegrees, 60);
  EXPECT_TRUE(look->statesLook && !look->statesFieldOfView);
  EXPECT_EQ(look->positionText, "1.5,2,300msl");

  const auto all = readCameraArgument("--camera", "1.5,2,10agl,+45,-90,33", {}, heights);
  ASSERT_TRUE(all) << all.error().describe();
  EXPECT_EQ(all->camera.verticalFieldOfViewDegrees, 33);
  EXPECT_TRUE(all->statesLook && all->statesFieldOfView);
}

TEST(CameraArgument, TellsItsPlaceWithoutTheTerrain) {
  for (const char* text : {"1.5,2,10", "1.5,2,300msl,45,-10", " 1.5 , 2 ,10agl,+45,-90,33"}) {
    const auto place = readCameraPlace("--camera", text, {});
    ASSERT_TRUE(place) << place.error().describe();
    EXPECT_EQ(*place, (Vec2{1.5, 2})) << text;
  }
  for (const char* text : {"1,2", "1,2,3,4", "1,east,3"}) {
    const auto place = readCameraPlace("--camera", text, {});
    const auto camera = readCameraArgument("--camera", text, {}, GroundHeights(slope()));
    ASSERT_FALSE(place);
    EXPECT_EQ(place.error().describe(), camera.error().describe());
  }
}

TEST(CameraArgument, RefusesWhatIsNoCameraAndNamesIt) {
  const GroundHeights heights(slope());
  const struct {
    const char *text, *words;
    ErrorCode code = ErrorCode::usage;
  } cases[] = {{"", "not 1 field"},
               {"1,2", "not 2 fields"},
               {"1,2,3,4", "not 4 fields"},
               {"1,2,3,4,5,6,7", "not 7 fields"},
               {"1,2,3,east,5", "'east' is not a number"},
               {"1,2,3,4,5,", "'' is not a number"},
               {"1,2,3,4,nan", "'nan' is not a number"},
               {"x,2,3,4,5", "'x' is not a number"},
               {"1,2,3asl,4,5", "is not a height"},
               {"1,2,3,4,91", "pitch"},
               {"1,2,3,4,5,180", "field of view"},
               {"1,2,3ell,4,5", "geoid"},
               {"-99,2,3,4,5", "no terrain below it", ErrorCode::invalidData}};
  for (const auto& c : cases) {
    const auto camera = readCameraArgument("--camera", c.text, {}, heights);
    ASSERT_FALSE(camera) << c.text;
    EXPECT_EQ(camera.error().code, c.code) << c.text;
    EXPECT_EQ(camera.error().culprit, std::string("--camera ") + c.text);
    EXPECT_NE(camera.error().message.find(c.words), std::string::npos) << camera.error().describe();
  }
}

TEST(CameraArgument, ComesBackFromItsTextToTheBit) {
  TerrainModel model = slope();
  for (const char* datum : {"", "ellipsoid"}) {
    model.georeference.verticalDatum = datum;
    const GroundHeights heights(model);
    Random random(1);
    for (int i = 0; i < 200; ++i) {
      const Camera camera{.xy = {random.between(-1e7, 1e7), random.between(-1e7, 1e7)},
                          .height = random.between(-1e4, 1e4),
                          .azimuthDegrees = random.between(0, 360),
                          .pitchDegrees = random.between(-90, 90),
                          .verticalFieldOfViewDegrees = random.between(0.1, 179)};
      const std::string text = cameraText(camera, model.georeference);
      const auto back = readCameraArgument("--camera", text, {}, heights);
      ASSERT_TRUE(back) << text << ": " << back.error().describe();
      EXPECT_TRUE(back->camera.xy == camera.xy && back->camera.height == camera.height &&
                  back->camera.azimuthDegrees == camera.azimuthDegrees &&
                  back->camera.pitchDegrees == camera.pitchDegrees &&
                  back->camera.verticalFieldOfViewDegrees == camera.verticalFieldOfViewDegrees)
          << "seed 1: " << text;
    }
  }
}

}  // namespace
}  // namespace arete
