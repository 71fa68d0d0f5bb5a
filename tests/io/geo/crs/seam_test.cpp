// SPDX-License-Identifier: GPL-3.0-or-later
//
// The same terrain on rasters that begin at different longitudes, some with their first column once more:
// what is at the seam of one is inside of another, so that each is the oracle of the others.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "io/geo/crs/ellipsoid_earth.h"
#include "io/geo/crs/longitude_turns.h"
#include "io/geo/crs/reader.h"
#include "io/geo/dem/seam_column.h"
#include "terrain/builder/build.h"
#include "terrain/locate/ground_height.h"
#include "terrain/model/plan_box.h"
#include "terrain/sight/paths.h"
#include "terrain/viewshed/viewshed.h"

namespace arete {
namespace {

constexpr int kAround = 36, kRows = 18;  // of 10 degrees

double heightAt(int cell, int row) {  // by the cell east of Greenwich
  const double x = 2 * std::numbers::pi * cell / kAround;
  return std::round(800 + 500 * std::sin(3 * x) * std::cos(0.4 * row) + 90 * std::cos(7 * x + row));
}

struct World {
  std::string name;
  RasterHeightfield field;
  TerrainModel model;
  std::unique_ptr<SightEarth> earth;

  /// @param first the cell, east of Greenwich, of the first column
  World(int first, bool isGridRegistered, double stepError = 0, bool hasVoid = false)
      : name("from " + std::to_string(10 * first) +
             (isGridRegistered ? ", with its first column again" : "")) {
    field.columns = kAround + (isGridRegistered ? 1 : 0);
    field.rows = kRows;
    for (int row = 0; row < kRows; ++row)
      for (unsigned column = 0; column < field.columns; ++column) {
        const int cell = ((first + int(column)) % kAround + kAround) % kAround;
        field.heights.push_back(hasVoid && cell == 18 && row == 9 ? std::nan("") : heightAt(cell, row));
      }
    Georeference& g = field.georeference;
    g.geoTransform = {10.0 * first, 10 + stepError, 0, 90, 0, -10};
    g.hasGeoTransform = true;
    EXPECT_TRUE(describeCrs(*crsFromText("EPSG:4326"), g));
    EXPECT_EQ(repeatFirstColumn(field), !isGridRegistered);
    auto built = build(field);
    EXPECT_TRUE(built) << built.error().describe();
    model = std::move(*built);
    auto made = makeEllipsoidEarth(model);
    EXPECT_TRUE(made);
    earth = std::move(*made);
  }

  Vec2 plan(Vec2 lonLat) const { return sightPlan(model, LongitudeTurns(model)(lonLat)); }
};

std::vector<std::unique_ptr<World>> worlds() {
  std::vector<std::unique_ptr<World>> all;
  for (const int first : {0, -18, -17, 5, 18, 30, -40})
    for (const bool isGridRegistered : {false, true})
      all.push_back(std::make_unique<World>(first, isGridRegistered));
  return all;
}

SightPathAnswer answerOn(const World& world, Vec2 from, Vec2 to, double above, SightMethod method) {
  const auto engine = makeSightEngine(method, world.model);
  EXPECT_TRUE(engine);
  const Profiles profiles(world.model, std::make_shared<const SightGrid>(world.model));
  const SightPath path{world.plan(from), world.plan(to), above, above};
  SightPathOptions options;
  const auto answer = answerPath(path, *world.earth, **engine, profiles, options);
  EXPECT_TRUE(answer) << world.name << ": " << answer.error().describe();
  return answer ? *answer : SightPathAnswer{};
}

struct Line {
  Vec2 from, to;
  double above;
};

std::vector<Line> linesAcross() {
  std::vector<Line> lines = {
      {{-5, 30}, {5, 32}, 20000},     {{175, 30}, {-175, 32}, 20000},  {{179, 5}, {-179, 5}, 3000},
      {{5, 5}, {355, 5}, 3000},       {{175, -45}, {185, -45}, 30000}, {{180, 10}, {170, 12}, 20000},
      {{-180, 10}, {170, 12}, 20000}, {{0, 15}, {0, 25}, 20000},       {{180, 15}, {180, 25}, 20000},
      {{185, 15}, {-165, 25}, 900},   {{165, 15}, {-165, 25}, 900}};
  std::mt19937 random(16);
  std::uniform_real_distribution<double> longitude(-180, 180), way(-25, 25), latitude(-60, 60),
      above(500, 60000);
  for (int i = 0; i < 30; ++i) {
    const Vec2 from{longitude(random), latitude(random)};
    lines.push_back({from, {from.x + way(random), from.y + way(random) / 2}, above(random)});
  }
  return lines;
}

TEST(Seam, ALineAcrossItIsThatOfARasterThatHasItElsewhere) {
  const auto all = worlds();
  for (const Line& line : linesAcross())
    for (const SightMethod method : {SightMethod::scan, SightMethod::pyramid, SightMethod::descent}) {
      const SightPathAnswer first = answerOn(*all.front(), line.from, line.to, line.above, method);
      for (const auto& world : all) {
        const SightPathAnswer answer = answerOn(*world, line.from, line.to, line.above, method);
        const std::string what = world->name + ", " + std::to_string(line.from.x) + " to " +
                                 std::to_string(line.to.x) + " by method " + std::to_string(int(method));
        EXPECT_EQ(answer.sight.verdict, first.sight.verdict) << what;
        EXPECT_NE(answer.sight.verdict, SightVerdict::unknown) << what;
        EXPECT_NEAR(answer.sight.gapMetres, 0, 1e-3) << what;
        EXPECT_NEAR(answer.distanceMetres, first.distanceMetres, 1e-3) << what;
        ASSERT_EQ(answer.sight.clearance.has_value(), first.sight.clearance.has_value()) << what;
        if (answer.sight.clearance) {
          EXPECT_NEAR(*answer.sight.clearance, *first.sight.clearance, 0.5) << what;
        }
      }
    }
}

TEST(Seam, ALineOverNodataIsUnknownWhereverTheSeamIs) {
  for (const int first : {0, -18, 17, 18, 19})
    for (const bool isGridRegistered : {false, true}) {
      const World world(first, isGridRegistered, 0, true);
      // The Earth rises by 130 km above the straight line.
      const SightPathAnswer answer = answerOn(world, {175, 3}, {195, -9}, 300000, SightMethod::pyramid);
      EXPECT_EQ(answer.sight.verdict, SightVerdict::unknown) << world.name;
      EXPECT_GT(answer.sight.gapMetres, 1000) << world.name;
      EXPECT_EQ(answerOn(world, {175, 43}, {195, 40}, 300000, SightMethod::pyramid).sight.verdict,
                SightVerdict::visible)
          << world.name;
    }
}

TEST(Seam, OfRoundedStepsHasNoSliver) {
  for (const double error : {1e-4, -1e-4, 1e-3, -1e-3, 1e-2, -1e-2})
    for (const int first : {0, -18}) {
      const World world(first, false, error);
      for (const Line& line : linesAcross()) {
        const SightPathAnswer answer = answerOn(world, line.from, line.to, 80000, SightMethod::pyramid);
        EXPECT_NE(answer.sight.verdict, SightVerdict::unknown)
            << world.name << " off by " << error << ", " << line.from.x << " to " << line.to.x;
      }
      const GroundHeights heights(world.model);
      const LongitudeTurns turns(world.model);
      for (double x = -200; x < 400; x += 0.037)
        ASSERT_TRUE(heights.at(turns({x, 33}))) << world.name << " off by " << error << " at " << x;
    }
}

TEST(Seam, HasTheHeightsAndTheProfileOfARasterThatHasItElsewhere) {
  const auto all = worlds();
  std::mt19937 random(17);
  std::uniform_real_distribution<double> longitude(-200, 380), latitude(-80, 80);
  std::vector<Vec2> places = {{180, 5}, {-180, 5}, {0, 5}, {360, 5}, {185, 5}, {175, 5}, {5, 5}, {355, 5}};
  for (int i = 0; i < 200; ++i) places.push_back({longitude(random), latitude(random)});
  const GroundHeights of(all.front()->model);
  const LongitudeTurns onto(all.front()->model);
  for (const auto& world : all) {
    const GroundHeights heights(world->model);
    const LongitudeTurns turns(world->model);
    for (const Vec2 place : places) {
      const auto here = heights.at(turns(place)), there = of.at(onto(place));
      ASSERT_TRUE(here && there) << world->name << " at " << place.x << ' ' << place.y;
      EXPECT_NEAR(here->height, there->height, 1e-6) << world->name << " at " << place.x << ' ' << place.y;
    }
    for (const auto& [from, to] : {std::pair{Vec2{170, 20}, Vec2{-170, 25}}, {Vec2{-12, 3}, Vec2{14, -8}}}) {
      const auto track = world->earth->track(world->plan(from), world->plan(to));
      ASSERT_TRUE(track) << world->name;
      const auto first = all.front()->earth->track(all.front()->plan(from), all.front()->plan(to));
      for (const bool hasGrid : {true, false}) {
        const Profile profile =
            Profiles(world->model, hasGrid ? std::make_shared<const SightGrid>(world->model) : nullptr)
                .along(*track);
        EXPECT_NEAR(profile.gapMetres, 0, 1e-3) << world->name;
        EXPECT_NEAR(profile.length, first->points.back().distance, 1e-3);
        double last = 0;
        for (std::size_t i = 0; i < profile.vertices.size(); ++i) {
          const ProfileVertex& v = profile.vertices[i];
          EXPECT_EQ(v.isJoined, i > 0) << world->name;
          EXPECT_GE(v.distance, last - 1e-6);
          last = v.distance;
          const Vec2 xy = world->model.toSource(v.plan);
          const auto height = of.at(onto(xy));
          ASSERT_TRUE(height) << xy.x;
          EXPECT_NEAR(v.height, height->height, 0.01) << world->name << " at " << xy.x;
        }
        EXPECT_NEAR(last, profile.length, 1e-3);
      }
    }
  }
}

TEST(Seam, AViewshedBesideItIsThatOfARasterThatHasItElsewhere) {
  const auto all = worlds();
  for (const Vec2 observer : {Vec2{3, 30}, {179, 30}, {-179, -25}, {185, 5}, {355, 12}, {180, 0}, {90, 40}}) {
    std::vector<int> first;
    for (const auto& world : all) {
      const auto maker = ViewshedMaker::make(world->model, *world->earth);
      ASSERT_TRUE(maker);
      ViewshedOptions options;
      options.field.greatestMetres = 4e6;
      const auto seen = maker->from({world->plan(observer), 9000}, options);
      ASSERT_TRUE(seen) << world->name << ": " << seen.error().describe();
      EXPECT_EQ(seen->withoutLine, 0u) << world->name;
      const int begin = int(std::lround(world->field.georeference.geoTransform[0] / 10));
      std::vector<int> byCell(std::size_t(kAround * kRows));
      for (unsigned row = 0; row < seen->rows; ++row)
        for (unsigned column = 0; column < seen->columns; ++column) {
          const int cell = ((begin + int(column)) % kAround + kAround) % kAround;
          const int value = byteOf(seen->cells[std::size_t(row) * seen->columns + column]);
          int& its = byCell[std::size_t(row) * kAround + std::size_t(cell)];
          if (column >= unsigned(kAround)) {
            EXPECT_EQ(value, its) << "the repeated column, " << world->name;
          }
          its = value;
        }
      if (first.empty()) first = byCell;
      int different = 0, decided = 0;
      for (std::size_t i = 0; i < first.size(); ++i) {
        different += byCell[i] != first[i];
        decided += first[i] != 1;
      }
      EXPECT_EQ(different, 0) << world->name << ", observer at " << observer.x;
      EXPECT_GT(decided, 20);
    }
  }
}

TEST(Seam, ASampleOverAPoleIsUnknownAndCounted) {
  for (const int first : {0, -18}) {
    const World world(first, false);
    const auto maker = ViewshedMaker::make(world.model, *world.earth);
    ASSERT_TRUE(maker);
    for (const Vec2 observer : {Vec2{90, 85}, {5, 5}}) {
      const auto seen = maker->from({world.plan(observer), 20000});
      ASSERT_TRUE(seen) << seen.error().describe();
      std::uint64_t unknown = 0;
      for (const ViewshedCell cell : seen->cells) unknown += cell == ViewshedCell::unknown;
      EXPECT_GE(unknown, seen->withoutLine);
      EXPECT_LT(seen->withoutLine, seen->cells.size() / 4) << "most samples have a line";
      EXPECT_GT(seen->seen + seen->hidden, 300u);
    }
  }
}

TEST(Seam, IsInNoColumnOfTheSource) {
  for (const int first : {0, -18}) {
    const World cells(first, false), grid(first, true);
    EXPECT_EQ(sourceColumns(cells.model), unsigned(kAround));
    EXPECT_EQ(sourceColumns(grid.model), unsigned(kAround) + 1);
    EXPECT_EQ(sourcePlanBox(cells.model).xMax, kAround - 1);
    EXPECT_EQ(sourcePlanBox(grid.model).xMax, kAround);
  }
}

}  // namespace
}  // namespace arete
