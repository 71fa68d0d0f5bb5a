// SPDX-License-Identifier: GPL-3.0-or-later
//
// Frusta against random points of them.
#include "engine/criteria/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/base/vec.h"

namespace arete {
namespace {

TEST(View, RefusesInvalidNumbersAndNamesThem) {
  View view;
  EXPECT_TRUE(view.validate());
  view.up = {0, 2, 0};
  EXPECT_NE(view.validate().error().message.find("two different directions"), std::string::npos);
  view = {};
  view.verticalFieldOfView = M_PI;
  EXPECT_NE(view.validate().error().message.find("180 degrees"), std::string::npos);
  view = {};
  view.heightPixels = 0;
  EXPECT_NE(view.validate().error().message.find("pixel"), std::string::npos);
  view = {};
  view.nearDistance = 2, view.farDistance = 1;
  EXPECT_NE(view.validate().error().message.find("near"), std::string::npos);
  view = {};
  view.eye.x = NAN;
  EXPECT_NE(view.validate().error().message.find("finite"), std::string::npos);
}

/// A point of the frustum, at a random place of the picture and a random depth.
Vec3 visiblePoint(const View& view, const Frustum& frustum, double scale, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const Frustum::Planes p = frustum.planes();
  const double z = view.nearDistance + scale * unit(random) * unit(random);
  const double x = p.slopeX * z * (2 * unit(random) - 1), y = p.slopeY * z * (2 * unit(random) - 1);
  return view.eye + x * p.right + y * p.up + z * p.forward;
}

View anyView(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  View view;
  view.eye = {100 * unit(random), 100 * unit(random), 100 * unit(random)};
  view.forward = {unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5};
  view.up = {unit(random) - 0.5, unit(random) + 0.6, unit(random) - 0.5};
  view.verticalFieldOfView = 0.1 + 2.5 * unit(random);
  view.widthPixels = 100 + 2000 * unit(random);
  view.heightPixels = 100 + 1000 * unit(random);
  if (random() % 2) view.nearDistance = unit(random);
  return view;
}

TEST(Frustum, HasOrthonormalAxesAndProjectsAlongThem) {
  std::mt19937_64 random(71);
  for (int round = 0; round < 200; ++round) {
    const View view = anyView(random);
    const Frustum frustum(view);
    const Frustum::Planes p = frustum.planes();
    EXPECT_NEAR(norm(p.right), 1, 1e-12);
    EXPECT_NEAR(norm(p.up), 1, 1e-12);
    EXPECT_NEAR(norm(p.forward), 1, 1e-12);
    EXPECT_NEAR(dot(p.right, p.up), 0, 1e-12);
    EXPECT_NEAR(dot(p.forward, p.up), 0, 1e-12);
    EXPECT_GT(dot(p.up, view.up), 0);
    const Vec3 ahead = frustum.toView(view.eye + 3.0 * p.forward);
    EXPECT_NEAR(ahead.x, 0, 1e-9);
    EXPECT_NEAR(ahead.y, 0, 1e-9);
    EXPECT_NEAR(ahead.z, 3, 1e-9);
  }
}

TEST(Frustum, MeetsEveryBallAndHullThatHasAVisiblePoint) {
  std::mt19937_64 random(72);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int round = 0; round < 5000; ++round) {
    const View view = anyView(random);
    const Frustum frustum(view);
    const Vec3 p = visiblePoint(view, frustum, 50, random);
    const double radius = 10 * (1 + unit(random));
    const Vec3 d{unit(random), unit(random), unit(random)};
    const Vec3 centre = p + (0.999 * radius / std::max(1e-9, norm(d))) * d;
    EXPECT_TRUE(frustum.mayMeet(frustum.toView(centre), radius * (1 + 1e-9) + 1e-9));
    // A segment through the point, both ends of which may be out of sight.
    const Vec3 hull[] = {frustum.toView(p + 30.0 * d), frustum.toView(p - 30.0 * d), frustum.toView(p)};
    EXPECT_TRUE(frustum.mayMeet(hull));
  }
}

TEST(Frustum, BoundsTheReachOfEveryVisiblePointOfABall) {
  std::mt19937_64 random(73);
  std::uniform_real_distribution<double> unit(-1, 1);
  double tightest = 0;
  for (int round = 0; round < 20000; ++round) {
    const View view = anyView(random);
    const Frustum frustum(view);
    const Vec3 p = visiblePoint(view, frustum, 50, random);
    const double radius = std::pow(10, 1.5 * unit(random) - 0.5);
    const Vec3 d{unit(random), unit(random), unit(random)};
    const Vec3 centre = frustum.toView(p + (0.999 * radius / std::max(1e-9, norm(d))) * d);
    const Vec3 q = frustum.toView(p);
    const double reach = q.z * q.z / norm(q), bound = frustum.reach(centre, radius, centre.z - radius);
    EXPECT_LE(bound, reach * (1 + 1e-6) + 1e-9);
    EXPECT_GE(bound, frustum.reachByDepth(centre.z - radius));
    if (radius < 0.01 * norm(q)) tightest = std::max(tightest, bound / reach);
  }
  EXPECT_GT(tightest, 0.9);
}

}  // namespace
}  // namespace arete
