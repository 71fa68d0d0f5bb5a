// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/crs/transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "io/geo/crs/reader.h"

namespace arete {
namespace {

Georeference georeferenceIn(const std::string& crs) {
  Georeference georeference;
  const auto parsed = crsFromText(crs);
  EXPECT_TRUE(parsed) << crs;
  if (parsed) {
    EXPECT_TRUE(describeCrs(*parsed, georeference));
  }
  return georeference;
}

TEST(CrsTransform, BringsLongitudeAndLatitudeIntoTheDemsCrs) {
  const auto utm = CrsTransform::fromLonLat(georeferenceIn("EPSG:32611"));
  ASSERT_TRUE(utm) << utm.error().describe();
  const auto p = (*utm)({-117, 34});  // the central meridian of zone 11
  ASSERT_TRUE(p);
  EXPECT_NEAR(p->x, 500000, 1e-6);
  EXPECT_NEAR(p->y, 3762155.9776, 1e-4);  // 0.9996 of the meridian arc, integrated numerically
  EXPECT_FALSE((*utm)({-117, 3400})) << "no latitude";
}

TEST(CrsTransform, LeavesLongitudeAndLatitudeOfTheSameCrsToTheBit) {
  const auto same = CrsTransform::fromLonLat(georeferenceIn("EPSG:4326"));
  ASSERT_TRUE(same);
  EXPECT_EQ((*same)({8.123456789, 46.5}).value(), (Vec2{8.123456789, 46.5}));
}

TEST(CrsTransform, TakesTheLongitudesOfAnotherBodyForItsOwn) {
  const std::string moon = "+proj=eqc +R=1737400 +units=m +no_defs";
  const auto transform = CrsTransform::fromLonLat(georeferenceIn(moon));
  ASSERT_TRUE(transform) << transform.error().describe();
  const auto p = (*transform)({90, 0});
  ASSERT_TRUE(p);
  EXPECT_NEAR(p->x, 1737400 * std::acos(0.0), 1e-3);
}

TEST(CrsTransform, NeedsACrsAndTellsWhichPositionsItCannotTell) {
  const auto none = CrsTransform::fromLonLat({});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::usage);
  const auto utm = CrsTransform::between("EPSG:4326", "EPSG:32611");
  ASSERT_TRUE(utm);
  std::vector<Vec2> places = {{-117, 34}, {-117, 1e9}, {-116, 34}};
  utm->apply(places);
  EXPECT_NEAR(places[0].x, 500000, 1e-6);
  EXPECT_TRUE(std::isnan(places[1].x));
  EXPECT_NEAR(places[2].x, 592361, 100);
}

TEST(CrsTransform, ThereAndBackIsWithinANanometreOfTheGround) {
  const auto there = CrsTransform::between("EPSG:32611", "EPSG:3857");
  const auto back = CrsTransform::between("EPSG:3857", "EPSG:32611");
  ASSERT_TRUE(there && back);
  for (double x = 300000; x <= 700000; x += 50000)
    for (double y = 3.5e6; y <= 4.5e6; y += 2.5e5) {
      const auto p = (*there)({x, y});
      ASSERT_TRUE(p);
      const auto q = (*back)(*p);
      ASSERT_TRUE(q);
      EXPECT_NEAR(q->x, x, 1e-6);
      EXPECT_NEAR(q->y, y, 1e-6);
    }
}

TEST(CrsTransform, GivesTheSameForManyPositionsAsForEach) {
  const auto transform = CrsTransform::between("OGC:CRS84", "EPSG:32611");
  ASSERT_TRUE(transform);
  std::vector<Vec2> positions;
  for (int i = 0; i < 70000; ++i)
    positions.push_back({-120 + i % 700 * 0.01, 30 + i / 700 * 0.1});  // two batches
  const std::vector<Vec2> before = positions;
  transform->apply(positions);
  for (std::size_t i = 0; i < positions.size(); i += 997)
    EXPECT_EQ((*transform)(before[i]).value(), positions[i]);
}

TEST(CrsTransform, IsTheIdentityForOneCrsAndWithoutAny) {
  const CrsTransform none;
  EXPECT_TRUE(none.isIdentity());
  EXPECT_TRUE(none.sourceWkt().empty());
  EXPECT_EQ(none({1, 2}).value(), (Vec2{1, 2}));
  const auto same = CrsTransform::between("EPSG:32611", "EPSG:32611+5703");
  ASSERT_TRUE(same) << same.error().describe();
  EXPECT_TRUE(same->isIdentity()) << "heights are not transformed";
  EXPECT_NE(same->sourceWkt().find("UTM zone 11N"), std::string::npos);
}

TEST(CrsTransform, RefusesWhatIsNotACrsAndAnotherBody) {
  const auto nonsense = CrsTransform::between("EPSG:32611", "gibberish");
  ASSERT_FALSE(nonsense);
  EXPECT_EQ(nonsense.error().code, ErrorCode::invalidData);
  EXPECT_NE(nonsense.error().message.find("gibberish"), std::string::npos);
}

TEST(CrsTransform, ShiftsLongitudesByTurnsBehindTheTransformation) {
  PointHeightfield field;
  field.georeference = georeferenceIn("EPSG:4326");
  field.positions = {{170, 0}, {190, 10}};
  field.heights = {0, 0};
  CrsTransform transform;
  transform.setTurns(LongitudeTurns(field));
  EXPECT_EQ(transform({-175, 5}).value(), (Vec2{185, 5}));
  EXPECT_EQ(transform({175, 5}).value(), (Vec2{175, 5}));
}

}  // namespace
}  // namespace arete
