// SPDX-License-Identifier: GPL-3.0-or-later
//
// Places of objects against places of the map, which a raster's metric space mirrors.
#include "viewer/scene/placement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "terrain/builder/build.h"
#include "viewer/scene/terrain_subject.h"

namespace arete {
namespace {

/// Slopes over 3 km by 3 km in UTM zone 32.
const TerrainModel& slopes() {
  static const TerrainModel model = [] {
    RasterHeightfield field;
    field.columns = field.rows = 31;
    for (std::uint32_t i = 0; i < 31 * 31; ++i) field.heights.push_back(float(300 + i % 31 + 2 * (i / 31)));
    field.georeference.geoTransform = {400000, 100, 0, 5200000, 0, -100};
    field.georeference.hasGeoTransform = true;
    field.georeference.crsWkt = "EPSG:32632";
    auto built = build(field);
    EXPECT_TRUE(built);
    return std::move(*built);
  }();
  return model;
}

TEST(Placement, AnObjectStandsInMetresOfTheMapTurnedClockwiseFromItsNorth) {
  const TerrainSubject ground(slopes());
  const Placement placement{
      .pivot = {5, 6, 7}, .anchor = ground.space().position({401000, 5198500}, 350), .scale = 2};
  const auto onMap = [&](const Placement& p, const Vec3& place) {
    return ground.inFile(placed(p, &ground)(place));
  };
  const auto expect = [](const Vec3& is, const Vec3& should) { EXPECT_LT(norm(is - should), 1e-6); };
  expect(onMap(placement, {5, 6, 7}), {401000, 5198500, 350});
  expect(onMap(placement, {5 + 10, 6 + 20, 7 + 30}), {401020, 5198540, 410});
  Placement turned = placement;
  turned.turn.heading = 90;  // what looked north looks east, what was east is south
  expect(onMap(turned, {5 + 10, 6 + 20, 7 + 30}), {401040, 5198480, 410});
  turned.turn = {.pitch = 90};
  expect(onMap(turned, {5, 6 + 20, 7}), {401000, 5198500, 390});
}

TEST(Placement, ExaggerationLiftsAnObjectWithItsGroundAndDoesNotStretchIt) {
  const TerrainSubject ground(slopes());
  const Vec3 anchor = ground.space().position({401000, 5198500}, 350);
  const Placement placement{.anchor = anchor, .turn = {30, 20, 10}, .scale = 3};
  ViewSettings settings;
  settings.stretch = 4;
  const Similarity drawn = placedAsDrawn(placement, &ground, settings), flat = placed(placement, &ground);
  EXPECT_LT(norm(drawn({}) - ground.drawn(anchor, settings)), 1e-9);
  EXPECT_LT(norm((drawn({1, 2, 3}) - drawn({})) - (flat({1, 2, 3}) - flat({}))), 1e-9);
}

TEST(Placement, OnACurvedEarthAnObjectStandsUprightWhereItIs) {
  const TerrainSubject ground(slopes());
  ViewSettings settings;
  settings.isCurved = true;
  ASSERT_TRUE(ground.curvedGround());
  std::mt19937 random(11);
  std::uniform_real_distribution<double> off(0, 2900), heading(0, 360);
  for (int i = 0; i < 20; ++i) {
    const Vec2 xy{400050 + off(random), 5199950 - off(random)};
    const Placement placement{.anchor = ground.space().position(xy, 400), .turn = {heading(random), 0, 0}};
    const Similarity drawn = placedAsDrawn(placement, &ground, settings);
    // Ten metres above its foot is where the scene draws ten metres higher.
    const Vec3 higher = ground.drawn(ground.space().position(xy, 410), settings);
    EXPECT_LT(norm(drawn({0, 0, 10}) - higher), 1e-3) << "seed 11, place " << i;
  }
}

TEST(Placement, WithoutASceneItIsItsOwnSimilarity) {
  const Placement placement{.pivot = {1, 0, 0}, .anchor = {10, 20, 30}, .turn = {.heading = 90}, .scale = 2};
  EXPECT_EQ(placed(placement, nullptr)({1, 1, 1}), (Vec3{12, 20, 32}));
}

}  // namespace
}  // namespace arete
