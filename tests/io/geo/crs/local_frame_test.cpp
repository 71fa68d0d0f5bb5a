// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/crs/local_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace arete {
namespace {

LocalFrameSpec earth(const Vec3& origin) {
  return {.origin = origin, .isGeographic = true, .middleLongitude = origin.x};
}

void expectNear(const Vec3& a, const Vec3& b, const Vec3& by) {
  EXPECT_NEAR(a.x, b.x, by.x);
  EXPECT_NEAR(a.y, b.y, by.y);
  EXPECT_NEAR(a.z, b.z, by.z);
}

/// Geocentric coordinates, straight from the definition of the ellipsoid.
Vec3 geocentric(double longitude, double latitude, double height, double a, double inverseFlattening) {
  const double f = inverseFlattening == 0 ? 0 : 1 / inverseFlattening, e2 = f * (2 - f);
  const double phi = latitude * std::numbers::pi / 180, lambda = longitude * std::numbers::pi / 180;
  const double n = a / std::sqrt(1 - e2 * std::sin(phi) * std::sin(phi));
  return {(n + height) * std::cos(phi) * std::cos(lambda), (n + height) * std::cos(phi) * std::sin(lambda),
          (n * (1 - e2) + height) * std::sin(phi)};
}

double distance(const Vec3& a, const Vec3& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

TEST(LocalFrame, OfAMapIsTheMapInMetres) {
  const auto frame =
      LocalFrame::create({.origin = {100, 200, 0}, .linearUnitMetres = 0.3048, .verticalUnitMetres = 0.5});
  ASSERT_TRUE(frame);
  expectNear(frame->toLocal({110, 220, 8}), {3.048, 6.096, 4}, {1e-12, 1e-12, 1e-12});
  expectNear(frame->toSource({3.048, 6.096, 4}), {110, 220, 8}, {1e-12, 1e-12, 1e-12});
}

TEST(LocalFrame, KeepsDistancesOfTheEllipsoid) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> offset(-2, 2), height(-400, 8800);
  for (const double inverseFlattening : {298.257223563, 0.0}) {
    for (const Vec3 origin :
         {Vec3{8.25, 46.5, 0}, Vec3{-117, -33.1, 100}, Vec3{179.9, 5, 0}, Vec3{0, 88, 0}}) {
      LocalFrameSpec spec = earth(origin);
      spec.inverseFlattening = inverseFlattening;
      const auto frame = LocalFrame::create(spec);
      ASSERT_TRUE(frame);
      expectNear(frame->toLocal(origin), {0, 0, 0}, {1e-6, 1e-6, 1e-6});
      Vec3 before = origin;
      for (int i = 0; i < 50; ++i) {
        const Vec3 p{origin.x + offset(random), origin.y + offset(random) / 2, height(random)};
        const auto on = [&](const Vec3& q) {
          return geocentric(q.x, q.y, q.z, spec.semiMajorAxisMetres, inverseFlattening);
        };
        EXPECT_NEAR(distance(frame->toLocal(p), frame->toLocal(before)), distance(on(p), on(before)), 1e-6);
        expectNear(frame->toSource(frame->toLocal(p)), p, {1e-11, 1e-12, 1e-7});
        before = p;
      }
    }
  }
}

TEST(LocalFrame, PointsEastNorthAndUp) {
  const auto frame = LocalFrame::create(earth({8, 46, 0}));
  ASSERT_TRUE(frame);
  EXPECT_GT(frame->toLocal({8.001, 46, 0}).x, 70);
  EXPECT_GT(frame->toLocal({8, 46.001, 0}).y, 100);
  EXPECT_NEAR(frame->toLocal({8, 46, 1000}).z, 1000, 1e-6);
  EXPECT_LT(frame->toLocal({8.5, 46, 0}).z, -100);  // the Earth curves away
}

TEST(LocalFrame, KeepsLongitudesTogetherAcrossTheAntimeridianAndRoundTheGlobe) {
  LocalFrameSpec spec = earth({179.95, 10, 0});
  spec.middleLongitude = 180;
  const auto across = LocalFrame::create(spec);
  ASSERT_TRUE(across);
  for (const double longitude : {179.0, 179.99, 180.0, 180.5, 181.0})
    EXPECT_NEAR(across->toSource(across->toLocal({longitude, 10, 0})).x, longitude, 1e-11);
  spec = earth({179.875, 0.125, 0});
  spec.middleLongitude = 180;
  const auto globe = LocalFrame::create(spec);
  ASSERT_TRUE(globe);
  for (const double longitude : {0.125, 90.0, 180.125, 359.875})
    for (const double latitude : {-89.875, -40.0, 89.875})
      EXPECT_NEAR(globe->toSource(globe->toLocal({longitude, latitude, 1000})).x, longitude, 1e-7);
}

TEST(LocalFrame, BoundsWhatRoundingDoesToSourceCoordinates) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const Vec3 origin : {Vec3{8, 46, 0}, Vec3{-70, -33, 0}, Vec3{20, 84, 0}}) {
    const auto frame = LocalFrame::create(earth(origin));
    ASSERT_TRUE(frame);
    const Vec3 low{origin.x - 1, origin.y - 1, -50}, high{origin.x + 1, origin.y + 1, 5000};
    const Vec3 metres{0.01, 0.02, 0.003};
    const Vec3 reach = frame->sourceReach(metres, low, high);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 p{origin.x + unit(random), origin.y + unit(random), 2475 + 2525 * unit(random)};
      Vec3 q = frame->toLocal(p);
      q = {q.x + metres.x * unit(random), q.y + metres.y * unit(random), q.z + metres.z * unit(random)};
      const Vec3 r = frame->toSource(q);
      ASSERT_LE(std::abs(r.x - p.x), reach.x);
      ASSERT_LE(std::abs(r.y - p.y), reach.y);
      ASSERT_LE(std::abs(r.z - p.z), reach.z);
    }
    EXPECT_LT(reach.y * 111000, 0.05);
    EXPECT_LT(reach.z, 0.005);
  }
}

TEST(LocalFrame, RefusesWhatMakesNoSense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(LocalFrame::create({.origin = {nan, 0, 0}}));
  EXPECT_FALSE(LocalFrame::create({.linearUnitMetres = 0}));
  EXPECT_FALSE(LocalFrame::create({.verticalUnitMetres = -1}));
  EXPECT_FALSE(LocalFrame::create({.origin = {0, 91, 0}, .isGeographic = true}));
  EXPECT_FALSE(LocalFrame::create({.isGeographic = true, .angularUnitRadians = 0}));
  EXPECT_FALSE(LocalFrame::create({.isGeographic = true, .semiMajorAxisMetres = 0}));
  EXPECT_FALSE(LocalFrame::create({.isGeographic = true, .inverseFlattening = 0.5}));
  EXPECT_FALSE(LocalFrame::create({.isGeographic = true, .middleLongitude = nan}));
  const auto frame = LocalFrame::create(earth({0, 80, 0}));
  ASSERT_TRUE(frame);
  EXPECT_FALSE(std::isfinite(frame->toLocal({0, 90.5, 0}).x));
}

}  // namespace
}  // namespace arete
