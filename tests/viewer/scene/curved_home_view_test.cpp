// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/scene/terrain_subject.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "viewer/true_earth.h"

namespace arete {
namespace {

using namespace test;

/// Where a picture of 2 x 2 has the samples of a terrain, every so many of them.
struct Seen {
  Vec2 low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
  double nearest = INFINITY;
  double most() const { return std::max({-low.x, high.x, -low.y, high.y}); }
};

Seen samplesIn(const Map& map, const CurvedGround& ground, const Camera& camera, double stretch) {
  const auto view = ground.viewOf(camera, stretch);
  EXPECT_TRUE(view) << view.error().describe();
  const Vec3 &f = view->forward, &u = view->up;
  Vec3 right{f.y * u.z - f.z * u.y, f.z * u.x - f.x * u.z, f.x * u.y - f.y * u.x};
  const double slope = std::tan(camera.verticalFieldOfViewDegrees * std::numbers::pi / 360),
               aspect = camera.widthPixels / camera.heightPixels;
  const RasterHeightfield samples = map.model.rasterSamples();
  Seen seen;
  for (std::uint32_t row = 0; row < samples.rows; ++row)
    for (std::uint32_t col = 0; col < samples.columns; ++col) {
      const Vec2 place = map.model.toSource({double(col), double(row)});
      const Vec3 p = ground.position(place, samples.at(col, row), stretch) - view->eye;
      const double depth = dot(p, f);
      const Vec2 at{dot(p, right) / (depth * slope * aspect), dot(p, u) / (depth * slope)};
      seen.nearest = std::min(seen.nearest, depth);
      seen.low = {std::min(seen.low.x, at.x), std::min(seen.low.y, at.y)};
      seen.high = {std::max(seen.high.x, at.x), std::max(seen.high.y, at.y)};
    }
  return seen;
}

Map planet(double west) {
  return mapOf("planet", 0, {west, 90}, 6, 61, 31, [](double lon, double lat) {
    return 2000 * std::sin(3 * lon * kRadians) * std::cos(lat * kRadians);
  });
}

TEST(CurvedHomeView, HasTheWholeTerrainInThePictureAWholePlanetToo) {
  std::vector<Map> all;
  for (const Map& map : maps()) all.push_back(map);
  all.push_back(planet(-180));
  all.push_back(planet(0));
  for (const Map& map : all) {
    const auto ground = CurvedGround::create(map.model);
    ASSERT_TRUE(ground) << ground.error().describe();
    const TerrainSubject subject(map.model);
    for (const HomeView view : kHomeViews)
      for (const double stretch : {1.0, 5.0}) {
        SCOPED_TRACE(std::string(map.name) + " from " + std::string(toString(view)) + ", heights times " +
                     std::to_string(stretch));
        const Camera camera = subject.home(view, {.widthPixels = 800, .heightPixels = 450},
                                           {.stretch = stretch, .isCurved = true});
        EXPECT_EQ(camera.widthPixels, 800);
        const Seen seen = samplesIn(map, *ground, camera, stretch);
        EXPECT_GT(seen.nearest, 0) << "all of it in front";
        EXPECT_LE(seen.most(), 0.93) << "all of it, with some room";
        EXPECT_GE(seen.most(), 0.6) << "and not far away";
      }
  }
}

TEST(CurvedHomeView, NorthIsUpAboveAPlanet) {
  const Map map = planet(-180);
  const TerrainSubject subject(map.model);
  ASSERT_TRUE(subject.curvedGround());
  for (const HomeView view : {HomeView::overview, HomeView::fromAbove}) {
    const Camera camera = subject.home(view, {}, {.isCurved = true});
    EXPECT_NEAR(std::remainder(camera.azimuthDegrees, 360), 0, 1) << toString(view);
    EXPECT_NEAR(camera.xy.x, 0, 1) << "over the middle of the map";
    EXPECT_NEAR(camera.xy.y, view == HomeView::overview ? -60 : 0, 1);
    EXPECT_LE(camera.pitchDegrees, -89);
  }
}

TEST(CurvedHomeView, IsThatOfTheFlatMapWhereTheTerrainIsSmall) {
  const Map map = mapOf("a valley", 33, {425000, 5262000}, 10, 101, 101, [](double lon, double lat) {
    return 500 * std::sin(3000 * lon) * std::cos(3000 * lat);
  });
  const TerrainSubject subject(map.model);
  ASSERT_TRUE(subject.curvedGround());
  for (const HomeView view : kHomeViews) {
    SCOPED_TRACE(toString(view));
    const Camera flat = subject.home(view, {}, {}), curved = subject.home(view, {}, {.isCurved = true});
    EXPECT_NEAR(curved.xy.x, flat.xy.x, 2);
    EXPECT_NEAR(curved.xy.y, flat.xy.y, 2);
    EXPECT_NEAR(curved.height, flat.height, 2);
    EXPECT_NEAR(std::remainder(curved.azimuthDegrees - flat.azimuthDegrees, 360), 0, 0.1);
    EXPECT_NEAR(curved.pitchDegrees, flat.pitchDegrees, 0.1);
  }
}

}  // namespace
}  // namespace arete
