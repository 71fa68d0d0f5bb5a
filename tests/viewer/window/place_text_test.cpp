// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinates that are shown and typed.
#include "viewer/window/place_text.h"

#include <gtest/gtest.h>
#include <cmath>
#include <string>

#include "terrain/locate/ground_height.h"
#include "viewer/camera_models.h"

namespace arete {
namespace {

const TerrainModel& projected() {
  return test::cameraModels()[0].model;
}

std::string typed(Vec2 xy) {
  return std::to_string(xy.x) + "," + std::to_string(xy.y);
}

TEST(PlaceText, ReadsThePlaceThatItWrites) {
  for (const test::CameraModel& m : test::cameraModels()) {
    SCOPED_TRACE(m.name);
    const GroundHeights heights(m.model);
    const PlaceText places(heights);
    const Vec2 xy =
        m.model.isRaster
            ? m.model.toSource({20, 15})
            : m.model.toSource({m.model.mt.arrays().metric.origin.x, m.model.mt.arrays().metric.origin.y});
    if (!heights.at(xy)) continue;
    const auto goal = places.read(places.xy(xy), false);
    ASSERT_TRUE(goal) << goal.error().describe();
    const double slack = m.model.georeference.isGeographic ? 1e-6 : 0.06;
    EXPECT_NEAR(goal->xy.x, xy.x, slack);
    EXPECT_NEAR(goal->xy.y, xy.y, slack);
    EXPECT_FALSE(goal->height) << "a place on the ground";
    EXPECT_NEAR(goal->ground, heights.at(goal->xy)->height, 1e-9);
  }
}

TEST(PlaceText, ResolvesHeightsAboveTheGroundAndAbsoluteOnes) {
  const GroundHeights heights(projected());
  const PlaceText places(heights);
  const Vec2 xy = projected().toSource({20, 15});
  const double ground = heights.at(xy)->height;
  const auto above = places.read(typed(xy) + ",100", false),
             level = places.read(typed(xy) + ",4321msl", false);
  ASSERT_TRUE(above && level);
  EXPECT_NEAR(*above->height, ground + 100, 1e-6);
  EXPECT_EQ(*level->height, 4321);
  EXPECT_NEAR(level->ground, ground, 1e-6);
}

TEST(PlaceText, RefusesPlacesOffTheTerrainUnlessTheyHaveAHeight) {
  const GroundHeights heights(projected());
  const PlaceText places(heights);
  const Vec2 off = projected().toSource({-500, 15});
  EXPECT_EQ(places.read(typed(off), false).error().code, ErrorCode::invalidData);
  EXPECT_FALSE(places.read(typed(off) + ",10", false)) << "above no ground";
  const auto absolute = places.read(typed(off) + ",900msl", false);
  ASSERT_TRUE(absolute) << absolute.error().describe();
  EXPECT_EQ(*absolute->height, 900);
  EXPECT_EQ(absolute->ground, 900);
}

TEST(PlaceText, NamesWhatCannotBeRead) {
  const GroundHeights heights(projected());
  const PlaceText places(heights);
  for (const char* text : {"", "1", "a,b", "1,2,3,4", "1,2,3xyz"}) {
    const auto goal = places.read(text, false);
    ASSERT_FALSE(goal) << text;
    EXPECT_NE(goal.error().culprit.find(text), std::string::npos) << goal.error().describe();
  }
}

TEST(PlaceText, HasNoLongitudeWithoutACrsThatHasOne) {
  const GroundHeights heights(projected());
  const PlaceText places(heights);
  EXPECT_FALSE(places.hasLonLat()) << "the CRS of this model is a name only";
  EXPECT_EQ(places.lonLat({1, 2}), "");
  EXPECT_FALSE(places.read("8.5,46.5", true));
}

TEST(PlaceText, WritesTheUnitOfHeights) {
  TerrainModel model = projected();
  {
    model.georeference.verticalUnit = "ft";
    const GroundHeights heights(model);
    EXPECT_EQ(PlaceText(heights).height(12.345678), "12.35 ft");
  }
  model.georeference.verticalUnit = "";
  const GroundHeights heights(model);
  EXPECT_EQ(PlaceText(heights).height(12.3), "12.30");
}

}  // namespace
}  // namespace arete
