// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/sight/paths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "datasets/families.h"
#include "datasets/random.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

TerrainModel modelOf(const RasterHeightfield& field) {
  auto model = build(field);
  EXPECT_TRUE(model);
  return std::move(*model);
}

TerrainModel fractal() {
  for (const RasterFamily& family : rasterFamilies())
    if (family.name == "fractal") return modelOf(family.make(64, 64, 5));
  ADD_FAILURE();
  return {};
}

std::vector<SightPath> somePaths(int count, double height) {
  Random random(3);
  std::vector<SightPath> paths;
  for (int i = 0; i < count; ++i)
    paths.push_back({{random.unit() * 63, random.unit() * 63},
                     {random.unit() * 63, random.unit() * 63},
                     height * random.unit(),
                     height * random.unit()});
  return paths;
}

/// A sphere, on which lines east along row 0 are known.
class Sphere final : public SightEarth {
 public:
  Result<SightTrack> track(Vec2 from, Vec2 to) const override {
    SightTrack track;
    track.points = {{from, 0}, {to, 1000 * std::hypot(to.x - from.x, to.y - from.y)}};
    track.groundCurvature = 1 / 6371e3;
    track.curvature = 6.0 / 7 / 6371e3;
    track.azimuthDegrees = 90;
    return track;
  }
};

TEST(SightPaths, AnswerManyAsTheyAnswerOne) {
  const TerrainModel model = fractal();
  const auto earth = makePlaneEarth(model);
  const Profiles profiles(model);
  const auto engine = makeSightDescent(model);
  SightPathOptions options;
  options.frequencyMegahertz = 900;
  const auto paths = somePaths(300, 200);
  for (const int threads : {1, 4}) {
    RunContext context;
    context.threads = threads;
    const auto all = answerPaths(paths, *earth, *engine, profiles, options, context);
    ASSERT_TRUE(all);
    ASSERT_EQ(all->size(), paths.size());
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const auto one = answerPath(paths[i], *earth, *engine, profiles, options);
      ASSERT_TRUE(one && (*all)[i]);
      EXPECT_EQ((*all)[i]->sight.verdict, one->sight.verdict);
      EXPECT_EQ((*all)[i]->sight.clearance, one->sight.clearance);
      EXPECT_EQ((*all)[i]->fresnel.has_value(), one->fresnel.has_value());
      if (!one->sight.clearance || !one->fresnel) continue;
      EXPECT_EQ(std::signbit(one->fresnel->fraction), *one->sight.clearance < 0) << i;
    }
  }
}

TEST(SightPaths, WithoutClutterAProfileIsJudgedAsTheEnginesJudge) {
  const TerrainModel model = fractal();
  const auto earth = makePlaneEarth(model);
  const Profiles profiles(model);
  const auto engine = makeSightDescent(model);
  SightPathOptions plain, bare, wood;
  bare.clutter.height = [](Vec2) { return 0.0; };
  wood.clutter.height = [](Vec2) { return 12.0; };
  for (const SightPath& path : somePaths(300, 300)) {
    const auto expected = answerPath(path, *earth, *engine, profiles, plain),
               found = answerPath(path, *earth, *engine, profiles, bare);
    ASSERT_TRUE(expected && found);
    EXPECT_EQ(found->sight.verdict, expected->sight.verdict);
    ASSERT_EQ(found->sight.clearance.has_value(), expected->sight.clearance.has_value());
    if (!expected->sight.clearance) continue;
    EXPECT_NEAR(*found->sight.clearance, *expected->sight.clearance, 1e-7);
    ASSERT_EQ(found->sight.obstruction.has_value(), expected->sight.obstruction.has_value());
    if (expected->sight.obstruction) {
      EXPECT_NEAR(found->sight.obstruction->distance, expected->sight.obstruction->distance, 1e-5);
    }
    // The same everywhere, it is as if the line were lower; at the ends themselves there is no clutter.
    const auto high = answerPath(path, *earth, *engine, profiles, wood);
    ASSERT_TRUE(high);
    EXPECT_NEAR(*high->sight.clearance, *expected->sight.clearance - 12, 1e-7);
  }
}

TEST(SightPaths, ElevationsAreThoseOfTriangles) {
  RasterHeightfield field;
  field.columns = field.rows = 60;
  field.heights.assign(3600, 0);
  const TerrainModel model = modelOf(field);
  const Profiles profiles(model);
  const auto engine = makeSightDescent(model);
  const Sphere earth;
  const SightPath path{{1, 1}, {51, 1}, 300, 2000};
  const auto answer = answerPath(path, earth, *engine, profiles, {});
  ASSERT_TRUE(answer);
  const double angle = 50000 / 6371e3, a = 6371e3 + 300, b = 6371e3 + 2000;
  const double expected = std::atan2(b * std::cos(angle) - a, b * std::sin(angle)) * 180 / std::numbers::pi;
  EXPECT_NEAR(answer->elevationDegrees, expected, 1e-9);
  EXPECT_EQ(answer->distanceMetres, 50000);
  const auto up = answerPath({{1, 1}, {1, 1}, 300, 2000}, *makePlaneEarth(model), *engine, profiles, {});
  ASSERT_TRUE(up);
  EXPECT_EQ(up->elevationDegrees, 90);
  EXPECT_EQ(up->sight.verdict, SightVerdict::visible);
}

TEST(SightPaths, RefuseHeightsThatAreNone) {
  const TerrainModel model = fractal();
  const Sphere earth;
  EXPECT_FALSE(sightLine({{1, 1}, {5, 5}, std::nan(""), 0}, earth, model));
  EXPECT_FALSE(sightLine({{1, 1}, {5, 5}, 0, -6e6}, earth, model));
  EXPECT_TRUE(sightLine({{1, 1}, {5, 5}, 0, -1e4}, earth, model));
}

TEST(SightPaths, BringLongitudesToTheTurnOfTheDem) {
  TerrainModel model;
  model.columns = model.rows = 21;
  model.georeference.isGeographic = true;
  model.georeference.crsWkt = "stands for one";
  model.georeference.geoTransform = {178.95, 0.1, 0, 1.05, 0, -0.1};
  EXPECT_NEAR(sightPlan(model, {-179.5, 0.5}).x, 15, 1e-9);
  EXPECT_NEAR(sightPlan(model, {180.5, 0.5}).x, 15, 1e-9);
  EXPECT_EQ(sightPlan(model, {180.5 + 1e-12, 0.5}).x, 15);
}

}  // namespace
}  // namespace arete
