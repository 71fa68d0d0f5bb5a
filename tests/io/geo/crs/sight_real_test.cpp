// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lines of sight on real terrain: where they run, against geodesics integrated step by step, and what they
// see, against the oracle. ARETE_FULL=1 takes 100 000 pairs on each DEM.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include "full_run.h"
#include "io/earth_oracle.h"
#include "io/geo/crs/ellipsoid_earth.h"
#include "io/geo/dem/dem_reader.h"
#include "io/io_fixture.h"
#include "terrain/builder/build.h"
#include "terrain/sight_pairs.h"

namespace arete::test {
namespace {

using Real = long double;

struct Dem {
  const char* path;
  /// Nothing for longitude and latitude on WGS 84.
  std::optional<OracleTransverseMercator> map;
};

const OracleEllipsoid kGrs80 = {6378137, 298.257222101L}, kAiry = {6377563.396L, 299.3249646L};

std::vector<Dem> dems() {
  return {{"dem/srtm1_bigtujunga_utm11.tif", OracleTransverseMercator{{}, 0, -117, 0.9996L, 500000, 0}},
          {"dem/srtm3_S33W071_aconcagua.tif", {}},
          {"dem/srtm3_N46E008_bernese_alps.tif", {}},
          {"dem/lidar2m_maungawhau_nztm.tif",
           OracleTransverseMercator{kGrs80, 0, 173, 0.9996L, 1600000, 10000000}},
          {"dem/lidar_dsm2.5m_edinburgh_bng.tif",
           OracleTransverseMercator{kAiry, 49, -2, 0.9996012717L, 400000, -100000}}};
}

TEST(EarthOracle, HasTheLengthsOfTheEquatorAndOfAMeridianAndTheAngleOfTheGraticule) {
  const OracleEllipsoid wgs84;
  const GeodesicPlace east = alongGeodesic(wgs84, {{0.3L, 0}, kDegree * 90}, 200000);
  EXPECT_NEAR(double(east.place.lon - 0.3L), 200000 / 6378137.0, 1e-16);
  EXPECT_NEAR(double(east.place.lat), 0, 1e-18);
  // A quarter of the WGS 84 meridian: 10 001 965.7293 m.
  GeodesicPlace north;
  for (int i = 0; i < 100; ++i) north = alongGeodesic(wgs84, north, 100019.657293127L);
  EXPECT_NEAR(double(north.place.lat / kDegree), 90, 1e-9);
  // A great circle of a sphere, from its northernmost place.
  const OracleEllipsoid sphere = {6371000, 0};
  const Real lat = 0.9L, angle = 0.1L;
  const GeodesicPlace at = alongGeodesic(sphere, {{0, lat}, kDegree * 90}, 6371000 * angle);
  EXPECT_NEAR(double(std::sin(at.place.lat)), double(std::sin(lat) * std::cos(angle)), 1e-11);
  EXPECT_NEAR(double(std::tan(at.place.lon)), double(std::tan(angle) / std::cos(lat)), 1e-10);
}

TEST(EarthOracle, ProjectsTheExampleOfGuidanceNote7AndBack) {
  const OracleTransverseMercator britain = {{6377563.396L, 299.32496L}, 49, -2, 0.9996013L, 400000, -100000};
  const auto at = britain.forward({0.5L * kDegree, 50.5L * kDegree});
  EXPECT_NEAR(double(at.east), 577274.99, 0.006);
  EXPECT_NEAR(double(at.north), 69740.50, 0.006);
  const LonLat back = britain.inverse(at);
  EXPECT_NEAR(double(back.lon / kDegree), 0.5, 1e-14);
  EXPECT_NEAR(double(back.lat / kDegree), 50.5, 1e-14);
}

class RealSights : public testing::TestWithParam<Dem> {
 protected:
  void SetUp() override {
    const std::filesystem::path path = realData(GetParam().path);
    if (path.empty()) GTEST_SKIP() << "the real DEMs are not here (../shared/data or $ARETE_DATA)";
    SourceReading reading;
    reading.band = 1;
    const auto dem = readDem(path.string(), reading);
    ASSERT_TRUE(dem) << dem.error().describe();
    field_ = std::get<RasterHeightfield>(dem->heightfield);
  }

  LonLat lonLatOf(Vec2 plan) const {
    const Vec2 at = field_.georeference.toSource(plan.x, plan.y);
    if (!GetParam().map) return {at.x * kDegree, at.y * kDegree};
    return GetParam().map->inverse({at.x, at.y});
  }
  Vec2 planOf(const LonLat& place) const {
    if (!GetParam().map)
      return field_.georeference.toGrid(double(place.lon / kDegree), double(place.lat / kDegree));
    const auto at = GetParam().map->forward(place);
    return field_.georeference.toGrid(double(at.east), double(at.north));
  }

  RasterHeightfield field_;
};

TEST_P(RealSights, RunOverGeodesicsAndTheEarthCurvesByEuler) {
  constexpr std::uint64_t kSeed = 31;
  SCOPED_TRACE(kSeed);
  TerrainModel model;
  model.columns = field_.columns;
  model.rows = field_.rows;
  model.georeference = field_.georeference;
  constexpr double kRefraction = 0.13;
  const auto earth = makeEllipsoidEarth(model, kRefraction);
  ASSERT_TRUE(earth) << earth.error().describe();
  const OracleEllipsoid ellipsoid = GetParam().map ? GetParam().map->ellipsoid : OracleEllipsoid();
  Random random(kSeed);
  std::size_t mostPieces = 0;
  for (int i = 0; i < (isFull() ? 2000 : 150); ++i) {
    const auto anywhere = [&] {
      return Vec2{random.between(-0.1, 1.1) * (field_.columns - 1),
                  random.between(-0.1, 1.1) * (field_.rows - 1)};
    };
    const Vec2 from = anywhere(), to = anywhere();
    const auto track = (*earth)->track(from, to);
    ASSERT_TRUE(track) << track.error().describe();
    const auto& points = track->points;
    const Real length = points.back().distance;
    ASSERT_EQ(points.front().plan, from);
    ASSERT_EQ(points.back().plan, to);
    ASSERT_EQ(points.front().distance, 0);
    const GeodesicPlace start = {lonLatOf(from), track->azimuthDegrees * kDegree};
    const auto expectNear = [&](Vec2 found, Real metres, double within) {
      const Vec2 expected = planOf(alongGeodesic(ellipsoid, start, metres).place);
      ASSERT_NEAR(found.x, expected.x, within) << from.x << " " << from.y << " to " << to.x << " " << to.y;
      ASSERT_NEAR(found.y, expected.y, within) << from.x << " " << from.y << " to " << to.x << " " << to.y;
    };
    // The geodesic of that azimuth and length arrives at the target, over all the places on its way.
    expectNear(to, length, 1e-6);
    for (std::size_t j = 1; j < points.size(); ++j) {
      const SightPoint &p = points[j - 1], &q = points[j];
      ASSERT_NEAR(q.distance - p.distance, double(length / Real(points.size() - 1)), 1e-6);
      if (j + 1 < points.size()) expectNear(q.plan, q.distance, 1e-6);
      expectNear({(p.plan.x + q.plan.x) / 2, (p.plan.y + q.plan.y) / 2}, (Real(p.distance) + q.distance) / 2,
                 1.001e-3);
      if (HasFatalFailure()) return;
    }
    // Half as many pieces would not do.
    double off = points.size() == 2 ? 1 : 0;
    for (std::size_t j = 1; j + 1 < points.size(); j += 2) {
      const Vec2 a = points[j - 1].plan, m = points[j].plan, b = points[j + 1].plan;
      off = std::max({off, std::fabs((a.x + b.x) / 2 - m.x), std::fabs((a.y + b.y) / 2 - m.y)});
    }
    ASSERT_GT(off, 0.999e-3);
    mostPieces = std::max(mostPieces, points.size() - 1);
    const GeodesicPlace middle = alongGeodesic(ellipsoid, start, length / 2);
    const Real radius = ellipsoid.inDirection(middle.place.lat, middle.azimuth);
    ASSERT_NEAR(double(track->curvature * radius / (1 - Real(kRefraction))), 1, 1e-9);
  }
  std::printf("at most %zu pieces\n", mostPieces);
}

TEST_P(RealSights, AreNeverWrong) {
  constexpr std::uint64_t kSeed = 32;
  SCOPED_TRACE(kSeed);
  const auto built = build(field_);
  ASSERT_TRUE(built) << built.error().describe();
  const TerrainModel& model = *built;
  const auto earth = makeEllipsoidEarth(model), refracted = makeEllipsoidEarth(model, 0);
  ASSERT_TRUE(earth && refracted);
  const auto plane = makePlaneEarth(model);
  auto grid = std::make_shared<const SightGrid>(model);
  struct Engine {
    const char* name;
    std::unique_ptr<SightEngine> engine;
  };
  std::vector<Engine> engines;
  engines.push_back({"scan", makeSightScan(grid)});
  engines.push_back({"pyramid", makeSightPyramid(grid)});
  engines.push_back({"descent", makeSightDescent(model)});
  const SightOracle oracle(field_);
  const SightTerrain terrain = terrainOf(field_, oracle);
  SightPairs pairs(terrain, {30, 0, field_.georeference.verticalUnitMetres}, kSeed);
  Random random(kSeed);
  const int count = isFull() ? 100'000 : 1'000;
  int failures = 0, visible = 0, blocked = 0, unknown = 0, close = 0, hang = 0, between = 0;
  for (int i = 0; i < count && failures < 10; ++i) {
    SightPair pair;
    pair.unit = field_.georeference.verticalUnitMetres;
    const auto [from, to] = pairs.ends(pair.kind, pair.isExact);
    const std::uint32_t which = random.below(4);
    const SightEarth& how = which == 0 ? *plane : which == 1 ? **refracted : **earth;
    pair.isExact = pair.isExact && which == 0;
    auto track = how.track(from, to);
    ASSERT_TRUE(track) << track.error().describe();
    pair.track = *track;
    pairs.setHeights(pair);
    SightOptions options;
    const std::uint32_t policy = random.below(10);
    options.nodata = policy == 0  ? NodataSight::blocked
                     : policy < 4 ? NodataSight::unknown
                                  : NodataSight::clear;
    options.wantsClearance = random.below(3) != 0;
    const SightLine line = lineOf(pair);
    std::optional<SightVerdict> verdict;
    for (const Engine& engine : engines) {
      const SightAnswer answer = engine.engine->answer(line, options);
      Rounding rounding = Rounding::none;
      const std::string what = wrongBeyondRounding(oracle, pair, options, answer, pairs.answer(), rounding);
      if (!what.empty() && ++failures < 10)
        ADD_FAILURE() << engine.name << ": " << what << "\n  pair " << i << ": " << describe(pair);
      if (!verdict) {
        verdict = answer.verdict;
        visible += *verdict == SightVerdict::visible;
        blocked += *verdict == SightVerdict::blocked;
        unknown += *verdict == SightVerdict::unknown;
        const auto c = pairs.answer().clearance;
        close += c && std::fabs(*c) * pair.unit <= 0.1L;
      }
      hang += rounding != Rounding::none;
      between += rounding == Rounding::between;
    }
    // The other way round, where it is the same line.
    if (i % 8 == 0) {
      const SightPair back = reversed(pair);
      const SightAnswer answer = engines[2].engine->answer(lineOf(back), options);
      Rounding rounding = Rounding::none;
      const OracleAnswer truth = oracle.ask(back.track, back.from, back.to, back.unit);
      const std::string what = wrongBeyondRounding(oracle, back, options, answer, truth, rounding);
      if (!what.empty() && ++failures < 10)
        ADD_FAILURE() << "descent from the other end: " << what << "\n  pair " << i << ": " << describe(back);
    }
  }
  const auto share = [&](int n) { return double(n) / count; };
  std::printf(
      "%d pairs, %.1f %% visible, %.1f %% blocked, %.1f %% unknown, %.1f %% within 0.1 m, %d hang on "
      "rounding (%d between)\n",
      count, 100 * share(visible), 100 * share(blocked), 100 * share(unknown), 100 * share(close), hang,
      between);
  EXPECT_GE(share(visible), 0.3);
  EXPECT_GE(share(blocked), 0.3);
  EXPECT_GE(share(close), 0.1);
  EXPECT_LE(share(hang), 0.03);
  EXPECT_LE(share(between), 0.001);
}

INSTANTIATE_TEST_SUITE_P(Dems, RealSights, testing::ValuesIn(dems()), [](const auto& made) {
  std::string name = std::filesystem::path(made.param.path).stem().string();
  std::ranges::replace_if(
      name, [](char c) { return !std::isalnum(c); }, '_');
  return name;
});

}  // namespace
}  // namespace arete::test
