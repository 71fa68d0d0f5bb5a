// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/crs/position_argument.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "io/files/text/length_unit.h"
#include "io/geo/crs/reader.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

Georeference georeferenceOf(const std::string& crs) {
  Georeference georeference;
  const auto parsed = crsFromText(crs);
  EXPECT_TRUE(parsed);
  EXPECT_TRUE(describeCrs(*parsed, georeference));
  return georeference;
}

/// z = 100 + x on 0..4 x 0..4, x to the right, y down.
TerrainModel slope() {
  RasterHeightfield field;
  field.columns = field.rows = 5;
  for (int i = 0; i < 25; ++i) field.heights.push_back(100 + i % 5);
  field.georeference.geoTransform = {-0.5, 1, 0, -0.5, 0, 1};
  auto model = build(field);
  EXPECT_TRUE(model);
  return std::move(*model);
}

TEST(PositionArgument, TurnsAUnitOfTheHeightIntoThatOfTheDem) {
  const DataUnit feet{0.3048}, unknown{};
  const struct {
    const char* text;
    double height;
    HeightKind kind;
  } cases[] = {{"1,2,3", 3, HeightKind::aboveGround},
               {"1,2,3m", 3 / 0.3048, HeightKind::aboveGround},
               {"1,2,3ft", 3, HeightKind::aboveGround},
               {"1,2,3 m agl", 3 / 0.3048, HeightKind::aboveGround},
               {"1,2,3mmsl", 3 / 0.3048, HeightKind::seaLevel},
               {"1,2,3ftell", 3, HeightKind::ellipsoidal},
               {"1,2,1.5kmMSL", 1500 / 0.3048, HeightKind::seaLevel}};
  for (const auto& c : cases) {
    const auto position = readPositionArgument("--from", c.text, CrsTransform(), &feet);
    ASSERT_TRUE(position) << c.text << ": " << position.error().describe();
    EXPECT_DOUBLE_EQ(position->height, c.height) << c.text;
    EXPECT_EQ(position->kind, c.kind) << c.text;
  }
  EXPECT_NE(readHeightText("3parsec", &feet).error().message.find("mm, cm, m"), std::string::npos);
  EXPECT_NE(readHeightText("3m", &unknown).error().message.find("is not known"), std::string::npos);
  EXPECT_FALSE(readHeightText("3m")) << "a column of a table holds numbers";
  EXPECT_FALSE(readPositionArgument("--from", "1m,2m,3", CrsTransform(), &feet)) << "a place has no unit";
}

TEST(PositionArgument, TakesAglMslEllAndNothing) {
  const struct {
    const char* text;
    double height;
    HeightKind kind;
  } cases[] = {{"1,2,3", 3, HeightKind::aboveGround},
               {"1,2,3agl", 3, HeightKind::aboveGround},
               {"1,2,-0.5msl", -0.5, HeightKind::seaLevel},
               {" 1 , 2 , 1e3 MSL ", 1000, HeightKind::seaLevel},
               {"1,+2,+3.25 ell", 3.25, HeightKind::ellipsoidal}};
  for (const auto& c : cases) {
    const auto position = readPositionArgument("--from", c.text, {});
    ASSERT_TRUE(position) << c.text << ": " << position.error().describe();
    EXPECT_EQ(position->xy, (Vec2{1, 2})) << c.text;
    EXPECT_EQ(position->height, c.height) << c.text;
    EXPECT_EQ(position->kind, c.kind) << c.text;
  }
}

TEST(PositionArgument, RefusesWhatIsNoPositionAndNamesIt) {
  for (const char* text : {"", "1", "1,2", "1,2,", "1,2,agl", "1,2,3,4", "1,2,3asl", "x,2,3", "1,nan,3",
                           "inf,2,3", "1,2,3 4", "1;2;3", "0x1,2,3"}) {
    const auto position = readPositionArgument("--from", text, {});
    ASSERT_FALSE(position) << text;
    EXPECT_EQ(position.error().code, ErrorCode::usage) << text;
    EXPECT_EQ(position.error().culprit, std::string("--from ") + text);
  }
  for (const char* text : {"", "1", "1,2,3", "1,", "one,two"}) {
    const auto place = readPlaceArgument("--at", text, {});
    ASSERT_FALSE(place) << text;
    EXPECT_EQ(place.error().culprit, std::string("--at ") + text);
  }
}

TEST(PositionArgument, HeightsAboveGroundStandOnTheTerrain) {
  const TerrainModel model = slope();
  const GroundHeights heights(model);
  EXPECT_NEAR(demHeight({{1.5, 2}, 10, HeightKind::aboveGround}, heights).value(), 111.5, 1e-9);
  EXPECT_EQ(demHeight({{1.5, 2}, 10, HeightKind::seaLevel}, heights).value(), 10);
  EXPECT_EQ(demHeight({{-7, 2}, 10, HeightKind::seaLevel}, heights).value(), 10);
  const auto nowhere = demHeight({{-7, 2}, 10, HeightKind::aboveGround}, heights);
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().code, ErrorCode::invalidData);
  EXPECT_EQ(nowhere.error().culprit, "-7,2,10agl");
}

TEST(PositionArgument, SeaLevelAndEllipsoidAreNotMixedWithoutAGeoid) {
  TerrainModel model = slope();
  EXPECT_FALSE(demHeight({{1, 1}, 10, HeightKind::ellipsoidal}, GroundHeights(model)));
  model.georeference.verticalDatum = "ellipsoid";
  EXPECT_EQ(demHeight({{1, 1}, 10, HeightKind::ellipsoidal}, GroundHeights(model)).value(), 10);
  EXPECT_FALSE(demHeight({{1, 1}, 10, HeightKind::seaLevel}, GroundHeights(model)));
}

TEST(PositionArgument, OfAPlaceInLongitudeAndLatitudeIsInTheDemsCrs) {
  const auto utm = CrsTransform::fromLonLat(georeferenceOf("EPSG:32611"));
  ASSERT_TRUE(utm);
  const auto place = readPlaceArgument("--at", "-117,34", *utm);
  ASSERT_TRUE(place);
  EXPECT_EQ(*place, (*utm)({-117, 34}).value());
  const auto refused = readPlaceArgument("--at", "-117,3400", *utm);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::usage);
  EXPECT_EQ(refused.error().culprit, "--at -117,3400");
}

}  // namespace
}  // namespace arete
