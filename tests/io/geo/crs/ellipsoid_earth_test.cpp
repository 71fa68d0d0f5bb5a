// SPDX-License-Identifier: GPL-3.0-or-later
//
// Held against closed forms on spheres, Karney's published geodesic, and properties of the track itself.
#include "io/geo/crs/ellipsoid_earth.h"

#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

#include "datasets/random.h"
#include "io/geo/crs/lonlat.h"
#include "io/geo/crs/reader.h"

namespace arete {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

/// A model of which only the place and the size are known.
TerrainModel modelOf(const std::string& crs, std::array<double, 6> geoTransform, std::uint32_t columns = 1001,
                     std::uint32_t rows = 1001) {
  TerrainModel model;
  model.columns = columns;
  model.rows = rows;
  model.georeference.geoTransform = geoTransform;
  const auto parsed = crsFromText(crs);
  EXPECT_TRUE(parsed) << crs;
  EXPECT_TRUE(describeCrs(*parsed, model.georeference)) << crs;
  return model;
}

/// Samples at whole multiples of `step` degrees from (west, north), south and east of it.
TerrainModel geographic(double west, double north, double step, std::uint32_t columns = 1001,
                        std::uint32_t rows = 1001, const std::string& crs = "EPSG:4326") {
  return modelOf(crs, {west - step / 2, step, 0, north + step / 2, 0, -step}, columns, rows);
}

SightTrack trackOf(const TerrainModel& model, Vec2 from, Vec2 to, double refraction = kUsualRefraction) {
  const auto earth = makeEllipsoidEarth(model, refraction);
  EXPECT_TRUE(earth) << earth.error().describe();
  auto track = (*earth)->track(from, to);
  EXPECT_TRUE(track) << track.error().describe();
  return track ? *track : SightTrack{};
}

std::string errorOf(const TerrainModel& model, Vec2 from, Vec2 to) {
  const auto earth = makeEllipsoidEarth(model);
  EXPECT_TRUE(earth);
  const auto track = (*earth)->track(from, to);
  return track ? "" : track.error().describe();
}

TEST(EllipsoidEarth, IsAsLongAsThePublishedGeodesic) {
  // Kennedy to Heathrow, the example of GeographicLib's GeodSolve: 51.1989, 5551.76 km.
  const TerrainModel model = geographic(-80, 60, 0.1);
  const SightTrack track = trackOf(model, model.toPlan({-73.8, 40.6}), model.toPlan({-0.5, 51.6}));
  EXPECT_NEAR(track.points.back().distance, 5551759.4, 0.05);
  EXPECT_NEAR(track.azimuthDegrees, 51.198882845, 1e-8);
}

TEST(EllipsoidEarth, OnASphereIsTheGreatCircle) {
  const double radius = 1737400;  // of the Moon
  const TerrainModel model = geographic(0, 50, 0.01, 1001, 1001, "+proj=longlat +R=1737400 +type=crs");
  const Vec2 from{100, 900}, to{850, 130};
  const SightTrack track = trackOf(model, from, to, 0.25);
  const Vec2 a = model.toSource(from), b = model.toSource(to);
  const auto unit = [](Vec2 p) {
    const double c = std::cos(p.y * kRadians);
    return Vec3{c * std::cos(p.x * kRadians), c * std::sin(p.x * kRadians), std::sin(p.y * kRadians)};
  };
  const Vec3 u = unit(a), v = unit(b);
  const double dot = u.x * v.x + u.y * v.y + u.z * v.z;
  EXPECT_NEAR(track.points.back().distance, radius * std::acos(dot), 1e-4);
  EXPECT_NEAR(track.curvature, 0.75 / radius, 1e-18);
  for (const SightPoint& p : track.points) {  // in the plane of the great circle
    const Vec3 w = unit(model.toSource(p.plan));
    const double det =
        u.x * (v.y * w.z - v.z * w.y) - u.y * (v.x * w.z - v.z * w.x) + u.z * (v.x * w.y - v.y * w.x);
    EXPECT_NEAR(det, 0, 1e-14);
    const double along = radius * std::acos(std::min(1.0, u.x * w.x + u.y * w.y + u.z * w.z));
    EXPECT_NEAR(along, p.distance, 1e-2);  // acos is poor near 1
  }
}

TEST(EllipsoidEarth, CurvesByEulersRadiusAtTheMiddle) {
  const TerrainModel model = geographic(0, 1, 0.002);
  const double a = 6378137, f = 1 / 298.257223563, e2 = f * (2 - f);
  // Along the equator N = a, across it M = a (1 - e2).
  EXPECT_NEAR(trackOf(model, {100, 500}, {200, 500}, 0).curvature, 1 / a, 1e-19);
  EXPECT_NEAR(trackOf(model, {100, 450}, {100, 550}, 0).curvature, 1 / (a * (1 - e2)), 1e-18);
  EXPECT_NEAR(trackOf(model, {100, 450}, {100, 550}).curvature, 6.0 / 7 / (a * (1 - e2)), 1e-18);
  EXPECT_EQ(trackOf(model, {100, 450}, {100, 550}, 1).curvature, 0);
  EXPECT_LT(trackOf(model, {100, 450}, {100, 550}, 1.5).curvature, 0);
}

TEST(EllipsoidEarth, AzimuthsGoClockwiseFromNorth) {
  const TerrainModel model = geographic(10, 47, 0.001);
  EXPECT_NEAR(trackOf(model, {500, 500}, {500, 400}).azimuthDegrees, 0, 1e-9);
  EXPECT_NEAR(trackOf(model, {500, 500}, {500, 600}).azimuthDegrees, 180, 1e-9);
  EXPECT_NEAR(trackOf(model, {500, 500}, {501, 500}).azimuthDegrees, 90, 1e-3);
  EXPECT_NEAR(trackOf(model, {500, 500}, {499, 500}).azimuthDegrees, 270, 1e-3);
}

/// The quarters of the pieces are within 1/1000 of a step; with half as many pieces one would not be.
void expectStraightEnough(const TerrainModel& model, Vec2 from, Vec2 to) {
  const SightTrack track = trackOf(model, from, to);
  const auto lonLat = CrsLonLat::of(model.georeference);
  ASSERT_TRUE(lonLat);
  std::array ends = {model.toSource(from), model.toSource(to)};
  lonLat->toLonLat(ends);
  const double a = model.georeference.semiMajorAxisMetres, rf = model.georeference.inverseFlattening;
  const GeographicLib::Geodesic geodesic(a, 1 / rf);
  double length = 0, azimuth = 0, unused = 0;
  geodesic.Inverse(ends[0].y, ends[0].x, ends[1].y, ends[1].x, length, azimuth, unused);
  EXPECT_NEAR(track.points.back().distance, length, 1e-6);
  const auto placeAt = [&](double s) {
    Vec2 p;
    geodesic.Direct(ends[0].y, ends[0].x, azimuth, s, p.y, p.x);
    lonLat->toCrs({&p, 1});
    return model.toPlan(p);
  };
  const auto worst = [&](std::size_t pieces) {
    double most = 0;
    for (std::size_t i = 0; i < pieces; ++i) {
      const double step = length / double(pieces);
      const Vec2 p = placeAt(double(i) * step), q = placeAt(double(i + 1) * step);
      for (const double t : {0.25, 0.5, 0.75}) {
        const Vec2 m = placeAt((double(i) + t) * step);
        most = std::max(
            {most, std::abs((1 - t) * p.x + t * q.x - m.x), std::abs((1 - t) * p.y + t * q.y - m.y)});
      }
    }
    return most;
  };
  const std::size_t pieces = track.points.size() - 1;
  EXPECT_EQ(track.points.front().plan, from);
  EXPECT_EQ(track.points.back().plan, to);
  EXPECT_EQ(pieces & (pieces - 1), 0u);
  EXPECT_LE(worst(pieces), 1.0001e-3);
  if (pieces > 1) {
    EXPECT_GT(worst(pieces / 2), 0.9999e-3);
  }
  for (std::size_t i = 1; i < pieces; ++i) {
    const Vec2 p = placeAt(length * double(i) / double(pieces));
    EXPECT_NEAR(track.points[i].plan.x, p.x, 1e-6);
    EXPECT_NEAR(track.points[i].plan.y, p.y, 1e-6);
  }
}

TEST(EllipsoidEarth, CutsTheGeodesicAsLittleAsItMay) {
  expectStraightEnough(geographic(10, 47, 1 / 3600.0), {3, 7}, {990.25, 612.5});
  expectStraightEnough(geographic(10, 47, 1 / 3600.0), {3, 7}, {3, 612.5});
  expectStraightEnough(geographic(10, 80, 1 / 1200.0), {3, 7}, {990.25, 12});
  expectStraightEnough(modelOf("EPSG:32611", {400000, 30, 0, 3800000, 0, -30}), {0, 0}, {1000, 900});
  expectStraightEnough(modelOf("EPSG:2056", {2600000, 2, 0, 1200000, 0, -2}), {10, 900}, {1000, 0});
  expectStraightEnough(modelOf("EPSG:3413", {-500000, 100, 0, 500000, 0, -100}, 10001, 10001), {2000, 3000},
                       {9000, 8000});
}

/// The largest deviation of a track from the geodesic between its ends, in steps, at many points of each leg:
/// by GeographicLib and PROJ.
double deviationOf(const TerrainModel& model, Vec2 from, Vec2 to) {
  const SightTrack track = trackOf(model, from, to);
  const auto lonLat = CrsLonLat::of(model.georeference);
  std::array ends = {model.toSource(track.points.front().plan), model.toSource(track.points.back().plan)};
  lonLat->toLonLat(ends);
  const double rf = model.georeference.inverseFlattening;
  const GeographicLib::Geodesic geodesic(model.georeference.semiMajorAxisMetres, rf == 0 ? 0 : 1 / rf);
  double length = 0, azimuth = 0, unused = 0;
  geodesic.Inverse(ends[0].y, ends[0].x, ends[1].y, ends[1].x, length, azimuth, unused);
  EXPECT_NEAR(track.points.back().distance, length, 1e-6);
  double worst = 0;
  constexpr int kPerLeg = 33;  // no point of the track's own tests but the middle
  for (std::size_t i = 1; i < track.points.size(); ++i) {
    const SightPoint &a = track.points[i - 1], &b = track.points[i];
    for (int k = 0; k <= kPerLeg; ++k) {
      const double t = double(k) / kPerLeg;
      Vec2 p;
      geodesic.Direct(ends[0].y, ends[0].x, azimuth, a.distance + t * (b.distance - a.distance), p.y, p.x);
      if (lonLat->isPlain()) p.x += 360 * std::round((model.toSource(a.plan).x - p.x) / 360);
      lonLat->toCrs({&p, 1});
      p = model.toPlan(p);
      worst = std::max({worst, std::abs((1 - t) * a.plan.x + t * b.plan.x - p.x),
                        std::abs((1 - t) * a.plan.y + t * b.plan.y - p.y)});
    }
  }
  return worst;
}

TEST(EllipsoidEarth, FollowsGeodesicsThatAreSymmetricAboutTheirMiddle) {
  // Across the equator a geodesic bends to both sides of its chord, and not in the middle.
  for (const double reach : {0.5, 1.0, 2.5, 5.0, 20.0, 40.0}) {
    const double step = reach / 500;
    const TerrainModel model = geographic(-reach, reach, step);
    EXPECT_LE(deviationOf(model, {0, 1000}, {1000, 0}), 1.1e-3) << reach;
    EXPECT_LE(deviationOf(model, {100, 700}, {900, 300}), 1.1e-3) << reach;
  }
  // The central meridian of UTM, and the poles of azimuthal maps, are such middles too.
  EXPECT_LE(deviationOf(modelOf("EPSG:32633", {200000, 600, 0, 5900000, 0, -600}), {0, 900}, {1000, 100}),
            1.1e-3);
  EXPECT_LE(deviationOf(modelOf("EPSG:3035", {2321000, 4000, 0, 5210000, 0, -4000}), {0, 900}, {1000, 100}),
            1.1e-3);
  EXPECT_LE(deviationOf(modelOf("EPSG:3857", {-2000000, 4000, 0, 2000000, 0, -4000}), {0, 900}, {1000, 100}),
            1.1e-3);
}

TEST(EllipsoidEarth, IsWithinItsStatedErrorOfEveryGeodesic) {
  constexpr std::uint64_t kSeed = 4102;
  Random random(kSeed);
  const std::array<TerrainModel, 7> models = {geographic(-179.5, 89.5, 1, 360, 180),
                                              geographic(0.5, 89.5, 1, 360, 180),
                                              geographic(179, -16, 0.002),
                                              geographic(-181, 62, 0.002),
                                              modelOf("EPSG:3413", {-1500000, 3000, 0, 1500000, 0, -3000}),
                                              modelOf("EPSG:3031", {-1500000, 3000, 0, 1500000, 0, -3000}),
                                              modelOf("EPSG:3035", {2500000, 3000, 0, 5500000, 0, -3000})};
  int lines = 0;
  for (std::size_t m = 0; m < models.size(); ++m)
    for (int i = 0; i < 20; ++i) {
      const TerrainModel& model = models[m];
      const auto place = [&] {
        return Vec2{random.between(0, model.columns - 1), random.between(0.1, 0.9) * (model.rows - 1)};
      };
      const Vec2 from = place(), to = place();
      const auto earth = makeEllipsoidEarth(model);
      // Lines over a pole of a map in degrees, or around its back, are errors by name.
      const auto track = (*earth)->track(from, to);
      if (!track || track->points.size() > 5000) continue;
      bool isTurned = false;  // led around a map of the world
      for (std::size_t k = 1; k < track->points.size(); ++k)
        isTurned = isTurned || track->points[k].distance == track->points[k - 1].distance;
      if (isTurned) continue;
      ++lines;
      EXPECT_LE(deviationOf(model, from, to), 1.1e-3) << "seed " << kSeed << ", model " << m << ": " << from.x
                                                      << ", " << from.y << " to " << to.x << ", " << to.y;
    }
  EXPECT_GE(lines, 100);
}

TEST(EllipsoidEarth, HasTheSameLineForAnyWayARasterLies) {
  const Vec2 a{412345, 3791234}, b{428765, 3776543};
  const auto lengthOn = [&](const TerrainModel& model) {
    const SightTrack track = trackOf(model, model.toPlan(a), model.toPlan(b));
    // atan2(16420, -14691) on the grid, which is turned by half a degree there.
    EXPECT_NEAR(track.azimuthDegrees, 131.28, 0.05);
    const Vec2 last = model.toSource(track.points[track.points.size() / 2].plan);
    EXPECT_NEAR(last.x, track.points.size() > 2 ? (a.x + b.x) / 2 : b.x, 5);
    return track.points.back().distance;
  };
  const std::string utm = "EPSG:32611";
  const double length = lengthOn(modelOf(utm, {400000, 30, 0, 3800000, 0, -30}));
  EXPECT_NEAR(lengthOn(modelOf(utm, {400000, 30, 0, 3700000, 0, 30})), length, 1e-6);     // south-up
  EXPECT_NEAR(lengthOn(modelOf(utm, {400000, 24, 18, 3800000, 18, -24})), length, 1e-6);  // rotated
  // The grid's scale: 0.9996 in the middle of the zone.
  EXPECT_NEAR(std::hypot(b.x - a.x, b.y - a.y) / length, 0.9997, 2e-4);
}

TEST(EllipsoidEarth, CountsInMetresWhateverTheMapsUnit) {
  const TerrainModel metres = modelOf("EPSG:26918", {580000, 10, 0, 4510000, 0, -10});
  const double foot = 1200.0 / 3937;
  const TerrainModel feet = modelOf("+proj=utm +zone=18 +datum=NAD83 +units=us-ft +type=crs",
                                    {580000 / foot, 10 / foot, 0, 4510000 / foot, 0, -10 / foot});
  EXPECT_NEAR(feet.georeference.linearUnitMetres, foot, 1e-12);
  const SightTrack a = trackOf(metres, {10, 20}, {800, 700}), b = trackOf(feet, {10, 20}, {800, 700});
  EXPECT_NEAR(a.points.back().distance, b.points.back().distance, 1e-6);
  EXPECT_NEAR(a.azimuthDegrees, b.azimuthDegrees, 1e-9);
  EXPECT_NEAR(a.curvature, b.curvature, 1e-18);
}

TEST(EllipsoidEarth, StaysOnTheDatumOfTheMap) {
  // A datum shift stated beside the CRS moves nothing.
  const std::array<double, 6> at = {600000, 30, 0, 5300000, 0, -30};
  const std::string plain = "+proj=utm +zone=32 +ellps=intl +units=m +type=crs";
  const std::string shifted = "+proj=utm +zone=32 +ellps=intl +towgs84=-87,-98,-121 +units=m +type=crs";
  const SightTrack a = trackOf(modelOf(plain, at), {10, 20}, {900, 500}),
                   b = trackOf(modelOf(shifted, at), {10, 20}, {900, 500});
  EXPECT_NEAR(a.points.back().distance, b.points.back().distance, 1e-6);
  EXPECT_NEAR(a.azimuthDegrees, b.azimuthDegrees, 1e-10);
}

TEST(EllipsoidEarth, TakesGradsAndOtherPrimeMeridians) {
  const TerrainModel grads = geographic(2, 52, 0.01, 101, 101, "EPSG:4807");  // Paris, grads
  const SightTrack track = trackOf(grads, {10, 10}, {60, 80});
  const Vec2 a = grads.toSource({10, 10}), b = grads.toSource({60, 80});
  double length = 0;
  GeographicLib::Geodesic(grads.georeference.semiMajorAxisMetres, 1 / grads.georeference.inverseFlattening)
      .Inverse(a.y * 0.9, a.x * 0.9, b.y * 0.9, b.x * 0.9, length);
  EXPECT_NEAR(track.points.back().distance, length, 1e-5);
}

TEST(EllipsoidEarth, KnowsWhereARotatedPoleIs) {
  // The origin of the turned grid is on the meridian of 10 degrees, 60 degrees from the equator.
  const TerrainModel model =
      geographic(-5, 5, 0.01, 1001, 1001,
                 "+proj=ob_tran +o_proj=longlat +o_lat_p=30 +o_lon_p=0 +lon_0=10 +datum=WGS84 "
                 "+type=crs");
  const auto lonLat = CrsLonLat::of(model.georeference);
  ASSERT_TRUE(lonLat) << lonLat.error().describe();
  std::array<Vec2, 1> p = {Vec2{0, 0}};
  lonLat->toLonLat(p);
  EXPECT_NEAR(p[0].x, 10, 1e-9);
  EXPECT_NEAR(std::abs(p[0].y), 60, 1e-9);
}

TEST(EllipsoidEarth, GoesOnOverTheAntimeridian) {
  const TerrainModel here = geographic(0, 1, 0.002), there = geographic(179, 1, 0.002),
                     west = geographic(-181, 1, 0.002);
  const SightTrack a = trackOf(here, {30, 40}, {900, 800}), b = trackOf(there, {30, 40}, {900, 800}),
                   c = trackOf(west, {30, 40}, {900, 800});
  ASSERT_EQ(a.points.size(), b.points.size());
  ASSERT_EQ(a.points.size(), c.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_NEAR(a.points[i].plan.x, b.points[i].plan.x, 1e-7);
    EXPECT_NEAR(a.points[i].plan.y, c.points[i].plan.y, 1e-7);
    EXPECT_NEAR(a.points[i].distance, b.points[i].distance, 1e-6);
  }
  // A projected one: UTM zone 1 reaches over it.
  expectStraightEnough(modelOf("EPSG:32601", {100000, 200, 0, 7000000, 0, -200}), {0, 500}, {1000, 480});
}

TEST(EllipsoidEarth, LeavesAMapOfTheWorldOnOneSideAndEntersItOnTheOther) {
  const TerrainModel world = geographic(-179.5, 89.5, 1, 360, 180);
  const Vec2 from = world.toPlan({178, 10}), to = world.toPlan({-177, 12});
  const SightTrack track = trackOf(world, from, to);
  EXPECT_EQ(track.points.front().plan, from);
  EXPECT_EQ(track.points.back().plan, to);
  EXPECT_LT(track.points.back().distance, 600e3);
  double least = 1e9, most = -1e9;
  for (std::size_t i = 1; i < track.points.size(); ++i) {
    const SightPoint &p = track.points[i - 1], &q = track.points[i];
    EXPECT_LE(p.distance, q.distance);
    const bool isOver = std::max(p.plan.x, q.plan.x) > 0 && std::min(p.plan.x, q.plan.x) < 359 &&
                        std::max(p.plan.y, q.plan.y) > 0;
    if (p.distance == q.distance) {
      EXPECT_FALSE(isOver);  // led around the map
      least = std::min(least, p.distance);
      most = std::max(most, p.distance);
    }
  }
  EXPECT_EQ(least, most);
  EXPECT_NEAR(least / track.points.back().distance, 2.0 / 5, 0.01);
  const SightTrack back = trackOf(world, to, from);
  EXPECT_NEAR(back.points.back().distance, track.points.back().distance, 1e-6);
  EXPECT_EQ(back.points.size(), track.points.size());
}

TEST(EllipsoidEarth, TwoEndsInOnePlaceAreNoDistanceApart) {
  const SightTrack track = trackOf(geographic(0, 1, 0.002), {30, 40}, {30, 40});
  EXPECT_EQ(track.points.back().distance, 0);
  EXPECT_EQ(track.points.size(), 2u);
}

TEST(EllipsoidEarth, SaysWhatIsNoLine) {
  const TerrainModel polar = geographic(-179.5, 90, 0.5, 719, 11);
  EXPECT_NE(errorOf(polar, polar.toPlan({-90, 88}), polar.toPlan({90, 88})).find("pole"), std::string::npos);
  const TerrainModel beyond = geographic(0, 91, 0.5, 11, 11);
  EXPECT_NE(errorOf(beyond, {0, 0}, {0, 5}).find("no longitude and latitude"), std::string::npos);
  const TerrainModel globe = geographic(-179.5, 89.5, 1, 360, 180);
  const auto earth = makeEllipsoidEarth(globe, -20);
  ASSERT_TRUE(earth);
  const auto track = (*earth)->track({10, 89}, {70, 92});
  ASSERT_FALSE(track);
  EXPECT_NE(track.error().describe().find("too long"), std::string::npos) << track.error().describe();

  TerrainModel nowhere;
  nowhere.columns = nowhere.rows = 3;
  const auto none = makeEllipsoidEarth(nowhere);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::usage);
  const TerrainModel local = modelOf("LOCAL_CS[\"site\",UNIT[\"metre\",1]]", {0, 1, 0, 0, 0, -1});
  const auto site = makeEllipsoidEarth(local);
  ASSERT_FALSE(site);
  EXPECT_EQ(site.error().code, ErrorCode::unsupported) << site.error().describe();
}

TEST(EllipsoidEarth, ServesManyThreadsAtOnce) {
  const TerrainModel model = modelOf("EPSG:32611", {400000, 30, 0, 3800000, 0, -30});
  const auto earth = makeEllipsoidEarth(model);
  ASSERT_TRUE(earth);
  const auto target = [](int i) { return Vec2{double(i * 37 % 1000), double(i * 91 % 1000)}; };
  std::vector<SightTrack> expected;
  for (int i = 0; i < 400; ++i) expected.push_back(*(*earth)->track({500.5, 500.5}, target(i)));
  std::atomic<int> different = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 400; ++i) {
        const auto track = (*earth)->track({500.5, 500.5}, target(i));
        const bool isSame = track && track->points.size() == expected[i].points.size() &&
                            track->points.back().distance == expected[i].points.back().distance &&
                            track->points[track->points.size() / 2].plan ==
                                expected[i].points[expected[i].points.size() / 2].plan;
        if (!isSame) ++different;
      }
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(different, 0);
}

}  // namespace
}  // namespace arete
