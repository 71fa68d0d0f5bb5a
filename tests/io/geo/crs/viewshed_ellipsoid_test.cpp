// SPDX-License-Identifier: GPL-3.0-or-later
//
// Viewsheds over the ellipsoid, where the sweep goes by a map of its own, cell by cell against an engine on
// the tracks as they are.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <variant>

#include "datasets/families.h"
#include "datasets/random.h"
#include "io/geo/crs/ellipsoid_earth.h"
#include "io/geo/crs/reader.h"
#include "io/geo/dem/dem_reader.h"
#include "io/io_fixture.h"
#include "terrain/builder/build.h"
#include "terrain/sight/profile.h"
#include "terrain/viewshed_cells.h"

namespace arete::test {
namespace {

struct Map {
  const char* crs;
  std::array<double, 6> geoTransform;
};

/// Cells of 1 km and of 30 m, far north and near the equator, turned, south up; metres; another ellipsoid.
const Map kMaps[] = {
    {"EPSG:4326", {10, 0.01, 0, 68, 0, -0.01}},           {"EPSG:4326", {-71, 0.0003, 0, -32, 0, -0.0003}},
    {"EPSG:4326", {30, 0.002, 0.001, 20, -0.001, 0.002}}, {"EPSG:32611", {120000, 100, 0, 4000000, 0, -100}},
    {"EPSG:27700", {300000, 2.5, 0, 700000, 0, -2.5}},
};

struct Tally : CellTally {
  int sweeps = 0;
};

Georeference georeferenceOf(const Map& map) {
  Georeference georeference;
  georeference.geoTransform = map.geoTransform;
  const auto crs = crsFromText(map.crs);
  EXPECT_TRUE(crs && describeCrs(*crs, georeference)) << map.crs;
  return georeference;
}

/// A raster on a map.
struct Ground {
  TerrainModel model;
  std::shared_ptr<const SightGrid> grid;
  std::unique_ptr<const SightEarth> earth;  // of the model; null where there is none

  Ground(const RasterHeightfield& field, const Georeference& georeference)
      : grid(std::make_shared<const SightGrid>(field.columns, field.rows, field.heights)) {
    model.columns = field.columns;
    model.rows = field.rows;
    model.georeference = georeference;
    if (auto made = makeEllipsoidEarth(model)) earth = std::move(*made);
  }
  Ground(const Ground&) = delete;
};

void compare(const Ground& terrain, const ViewshedObserver& observer, const ViewshedOptions& options,
             std::size_t every, const std::string& what, Tally& tally) {
  const auto maker = ViewshedMaker::make(terrain.model, *terrain.earth, terrain.grid);
  ASSERT_TRUE(maker);
  const auto viewshed = maker->from(observer, options);
  ASSERT_TRUE(viewshed) << viewshed.error().describe();
  tally.sweeps += viewshed->method == ViewshedMethod::sweep;
  const auto engine = makeSightPyramid(terrain.grid);
  expectCells(*viewshed,
              {*terrain.earth, *engine, *terrain.grid, terrain.model.georeference.verticalUnitMetres},
              observer, options, what, tally, observer.plan.x > 0 ? 1 : 0, every);
}

/// Every family on every map: visit(terrain, what, tally) compares some viewsheds. Returns the sums.
template <class Visit>
Tally onEveryGround(std::uint32_t seed, const Visit& visit) {
  Tally all;
  for (const Map& map : kMaps)
    for (const RasterFamily& family : rasterFamilies()) {
      const Ground terrain(family.make(71, 84, seed), georeferenceOf(map));
      const std::string what = std::string(family.name) + " on " + map.crs;
      if (terrain.earth == nullptr) {
        ADD_FAILURE() << what << " has no earth";
        continue;
      }
      Tally tally;
      visit(terrain, what, tally);
      EXPECT_EQ(tally.wrong, 0u) << what;
      all.sweeps += tally.sweeps;
      all.rays += tally.rays;
      all.cells += tally.cells;
    }
  return all;
}

/// Away from the border.
Vec2 placeOn(const Ground& terrain, Random& random) {
  return {random.between(2, terrain.model.columns - 3), random.between(2, terrain.model.rows - 3)};
}

TEST(ViewshedEllipsoid, TheSweepGivesTheAnswersOfAnEngine) {
  Random random(11);
  const Tally all = onEveryGround(4, [&](const Ground& terrain, const std::string& what, Tally& tally) {
    for (int i = 0; i < 3; ++i) {
      Vec2 plan = placeOn(terrain, random);
      if (i == 1) plan = {std::round(plan.x), std::round(plan.y)};
      const double ground = terrain.grid->at(plan), heights[] = {2, 30, 10};
      ViewshedOptions options;
      options.targetHeight = i == 2 ? 2 : 0;
      options.nodata = static_cast<NodataSight>(i);
      compare(terrain, {plan, (std::isnan(ground) ? 100 : ground) + heights[i]}, options, 1, what, tally);
    }
  });
  EXPECT_GT(all.sweeps, 100);
  EXPECT_LT(all.rays, all.cells / 2);
}

TEST(ViewshedEllipsoid, GivesTheAnswersOfAnEngineOnMapsOfTheWorldAndAboutTheirCentres) {
  // Across the equator and about the centres of azimuthal maps geodesics bend to both sides of their chords.
  const Map maps[] = {{"EPSG:4326", {-2.5, 0.07, 0, 2.9, 0, -0.07}},
                      {"EPSG:4326", {179, 0.03, 0, -16, 0, -0.03}},
                      {"EPSG:4326", {300, 1.6, 0, 50, 0, -1}},
                      {"EPSG:3035", {4144000, 5000, 0, 3390000, 0, -5000}},
                      {"EPSG:3413", {-355000, 10000, 0, 420000, 0, -10000}},
                      {"EPSG:3857", {0, 3000, 0, 130000, 0, -3000}}};
  constexpr std::uint32_t kSeed = 41;
  Random random(kSeed);
  int observers = 0;
  for (const Map& map : maps)
    for (const std::size_t family : {std::size_t{1}, std::size_t{3}}) {
      const Ground terrain(rasterFamilies()[family].make(71, 84, kSeed), georeferenceOf(map));
      ASSERT_NE(terrain.earth, nullptr) << map.crs;
      Tally tally;
      const std::string what = std::string(rasterFamilies()[family].name) + " on " + map.crs;
      for (const Vec2 plan : {Vec2{3, 80}, placeOn(terrain, random), placeOn(terrain, random)}) {
        const double ground = terrain.grid->at(plan);
        ViewshedOptions options;
        options.targetHeight = 1000;
        compare(terrain, {plan, (std::isnan(ground) ? 100 : ground) + 1000}, options, 7, what, tally);
        ++observers;
      }
      EXPECT_EQ(tally.wrong, 0u) << what << ", seed " << kSeed;
    }
  EXPECT_EQ(observers, 36);
}

TEST(ViewshedEllipsoid, TheSweepGivesTheAnswersOfAnEngineToObserversAsHighAsSatellites) {
  Random random(13);
  const Tally all = onEveryGround(5, [&](const Ground& terrain, const std::string& what, Tally& tally) {
    for (const double height : {1e4, 4e5, 4e7})
      compare(terrain, {placeOn(terrain, random), height}, {}, 3, what, tally);
  });
  EXPECT_GT(all.sweeps, 50);
}

TEST(ViewshedEllipsoid, EveryEngineAndTheProfileKnowTheLineToASatellite) {
  Random random(14);
  const Map& map = kMaps[3];
  RasterHeightfield field = rasterFamilies()[3].make(71, 84, 6);
  field.georeference.geoTransform = map.geoTransform;
  const auto crs = crsFromText(map.crs);
  ASSERT_TRUE(crs && describeCrs(*crs, field.georeference));
  const auto built = build(field);
  ASSERT_TRUE(built) << built.error().describe();
  const auto earth = makeEllipsoidEarth(*built);
  ASSERT_TRUE(earth);
  const auto grid = std::make_shared<const SightGrid>(*built);
  const Profiles profiles(*built, grid);
  for (const SightMethod method :
       {SightMethod::scan, SightMethod::pyramid, SightMethod::descent, SightMethod::embree}) {
    const auto engine = makeSightEngine(method, *built, grid);
    if (!engine) continue;  // built without it
    for (const double height : {2e5, 6e5, 2e6, 4e7})
      for (int i = 0; i < 20; ++i) {
        const auto place = [&] {
          return Vec2{double(random.below(field.columns)), double(random.below(field.rows))};
        };
        const Vec2 from = place(), to = place();
        if (from == to) continue;
        const auto track = (*earth)->track(from, to);
        ASSERT_TRUE(track);
        const double ground = grid->at(to);
        const SightLine line(*track, height, ground + 2);
        const SightAnswer answer = (*engine)->answer(line, {});
        // So steep a line has nothing nearer below it than its lower end.
        EXPECT_EQ(answer.verdict, SightVerdict::visible);
        ASSERT_TRUE(answer.clearance);
        EXPECT_NEAR(*answer.clearance, 2, 1e-6) << height;
        EXPECT_NEAR(answer.least.distance, line.length(), 1e-6);
        const Profile profile = profiles.along(*track);
        ASSERT_FALSE(profile.vertices.empty());
        const ProfileVertex& last = profile.vertices.back();
        EXPECT_NEAR(line.height(last.distance) - last.height, 2, 1e-6);
        EXPECT_NEAR(line.height(0), height, 1e-6);
      }
  }
}

TEST(ViewshedEllipsoid, TheSweepGivesTheAnswersOfAnEngineWhereNodataIsScattered) {
  const std::uint64_t seeds = std::getenv("ARETE_FULL") != nullptr ? 12 : 1;
  Tally all;
  for (const Map& map : kMaps)
    for (const double share : {0.01, 0.1, 0.4})
      for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        Random random(seed * 100 + static_cast<std::uint64_t>(100 * share));
        RasterHeightfield field = rasterFamilies()[3].make(67, 74, seed + 1);
        const bool isPatches = random.below(2) == 0;
        std::vector<Vec2> voids;
        for (std::uint32_t row = 0; row < field.rows; ++row)
          for (std::uint32_t column = 0; column < field.columns; ++column) {
            const std::uint32_t size = isPatches ? 3 : 1;
            if (Random::toUnit(Random::at(seed, column / size, row / size)) >= share) continue;
            field.heights[std::size_t{row} * field.columns + column] = std::nan("");
            voids.push_back({double(column), double(row)});
          }
        ASSERT_FALSE(voids.empty());
        const Ground terrain(field, georeferenceOf(map));
        ASSERT_NE(terrain.earth, nullptr);
        Tally tally;
        const std::string what = "share " + std::to_string(share) + ", seed " + std::to_string(seed);
        for (int i = 0; i < 6; ++i) {
          Vec2 plan = voids[random.below(static_cast<std::uint32_t>(voids.size()))];
          plan.x = std::clamp(plan.x + double(random.below(3)) - 1, 2.0, field.columns - 3.0);
          plan.y = std::clamp(plan.y + double(random.below(3)) - 1, 2.0, field.rows - 3.0);
          if (i % 2 == 1) plan = {plan.x + random.unit() - 0.5, plan.y + random.unit() - 0.5};
          plan = {std::max(plan.x, 2.0), std::max(plan.y, 2.0)};
          const double ground = terrain.grid->at(plan), heights[] = {2, 30, 10};
          ViewshedOptions options;
          options.targetHeight = i % 3 == 2 ? 2 : 0;
          options.nodata = static_cast<NodataSight>(i % 3);
          compare(terrain, {plan, (std::isnan(ground) ? 100 : ground) + heights[i / 2]}, options, 1,
                  what + " on " + map.crs, tally);
        }
        EXPECT_EQ(tally.wrong, 0u) << what << " on " << map.crs;
        all.sweeps += tally.sweeps;
        all.rays += tally.rays;
        all.cells += tally.cells;
      }
  RecordProperty("sweeps", std::to_string(all.sweeps));
  RecordProperty("rays", std::to_string(all.rays) + " of " + std::to_string(all.cells));
  EXPECT_GT(all.sweeps, 40);
}

TEST(ViewshedEllipsoid, WithinARadiusNeedsNoLinesToTheOtherSideOfTheWorld) {
  // The shortest ways to half of the cells pass a pole or the seam: no lines on the map, but far out of
  // range.
  RasterHeightfield field;
  field.columns = 72;
  field.rows = 35;
  for (std::uint32_t i = 0; i < field.columns * field.rows; ++i) field.heights.push_back(10.0 * (i % 7));
  const Ground terrain(field, georeferenceOf({"EPSG:4326", {-180, 5, 0, 87.5, 0, -5}}));
  ASSERT_TRUE(terrain.earth);
  const auto maker = ViewshedMaker::make(terrain.model, *terrain.earth, terrain.grid);
  ASSERT_TRUE(maker);
  const ViewshedObserver observer{{20, 12}, 5000};
  for (const ViewshedMethod method : {ViewshedMethod::automatic, ViewshedMethod::rays}) {
    ViewshedOptions options;
    options.method = method;
    const auto whole = maker->from(observer, options);
    ASSERT_TRUE(whole) << whole.error().describe();
    EXPECT_GT(whole->withoutLine, 0u) << "a cell without a line is unknown, and counted";
    EXPECT_GE(std::ranges::count(whole->cells, ViewshedCell::unknown), std::ptrdiff_t(whole->withoutLine));
    options.field.greatestMetres = 3000e3;
    const auto viewshed = maker->from(observer, options);
    ASSERT_TRUE(viewshed) << viewshed.error().describe();
    std::size_t inRange = 0;
    for (std::size_t i = 0; i < viewshed->cells.size(); ++i) {
      const Vec2 cell{double(i % field.columns), double(i / field.columns)};
      const auto distance = terrain.earth->distance(observer.plan, cell);
      ASSERT_TRUE(distance);
      EXPECT_EQ(viewshed->cells[i] == ViewshedCell::outside, *distance > 3000e3) << i;
      inRange += *distance <= 3000e3;
    }
    EXPECT_GT(inRange, 20u);
  }
}

TEST(ViewshedEllipsoid, TheSweepGivesTheAnswersOfAnEngineOnRealDems) {
  Random random(12);
  std::size_t compared = 0;
  for (const char* name : {"srtm3_N46E008_bernese_alps.tif", "srtm3_S33W071_aconcagua.tif",
                           "srtm1_bigtujunga_utm11.tif", "lidar_dsm2.5m_edinburgh_bng.tif"}) {
    const std::filesystem::path path = realData(std::string("dem/") + name);
    if (path.empty()) continue;
    ++compared;
    const auto dem = readDem(path.string());
    ASSERT_TRUE(dem);
    const auto& field = std::get<RasterHeightfield>(dem->heightfield);
    const Ground terrain(field, field.georeference);
    ASSERT_NE(terrain.earth, nullptr);
    Tally tally;
    for (int i = 0; i < 3; ++i) {
      Vec2 plan;
      do plan = {double(random.below(field.columns)), double(random.below(field.rows))};
      while (std::isnan(terrain.grid->at(plan)));
      compare(terrain, {plan, terrain.grid->at(plan) + 3}, {}, 97, name, tally);
    }
    EXPECT_EQ(tally.wrong, 0u) << name;
    RecordProperty("rays of " + std::string(name), std::to_string(tally.rays));
  }
  if (compared == 0) GTEST_SKIP() << "the real DEMs are not here (../shared/data or $ARETE_DATA)";
}

}  // namespace
}  // namespace arete::test
