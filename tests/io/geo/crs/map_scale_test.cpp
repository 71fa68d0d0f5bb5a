// SPDX-License-Identifier: GPL-3.0-or-later
//
// Against the closed forms of the projections on the sphere and the ellipsoid [Snyder1987].
#include "io/geo/crs/map_scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "io/geo/crs/local_frame.h"
#include "io/georeference_fixture.h"

namespace arete {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180, kA = 6378137;

double mercatorY(double latitude) {
  return kA * std::asinh(std::tan(latitude * kRadiansPerDegree));
}

TEST(MapScale, OfWebMercatorIsThatOfTheEllipsoidUnderASphere) {
  const Georeference g = test::georeferenceOf("EPSG:3857");
  const double e2 = 2 / 298.257223563 - 1 / 298.257223563 / 298.257223563;
  for (const double latitude : {0.0, 30.0, -60.0, 80.0}) {
    const auto scale = mapScaleAt(g, {1e6, mercatorY(latitude)});
    ASSERT_TRUE(scale);
    const double s = std::sin(latitude * kRadiansPerDegree), c = std::cos(latitude * kRadiansPerDegree),
                 w = std::sqrt(1 - e2 * s * s);
    EXPECT_NEAR((*scale)[0], w / c, 1e-6 / c) << latitude;
    EXPECT_NEAR((*scale)[1], w * w * w / (1 - e2) / c, 1e-6 / c) << latitude;
  }
}

TEST(MapScale, IsStatedWhereTheMapIsFarFromTrue) {
  Georeference g = test::georeferenceOf("EPSG:3857", {1e6, 20, 0, mercatorY(60), 0, -20});
  stateMapScale(g, {1e6, mercatorY(60)});
  ASSERT_TRUE(g.mapScale);
  const Vec2 step = groundStep(g, 0, 0);
  EXPECT_NEAR(step.x, 20 * std::cos(60 * kRadiansPerDegree), 0.03);
  EXPECT_NEAR(step.y, 20 * std::cos(60 * kRadiansPerDegree), 0.03);
  const auto frame = LocalFrame::create(localFrameSpec(g, {1e6, mercatorY(60), 100}));
  ASSERT_TRUE(frame);
  const Vec3 local = frame->toLocal({1e6 + 1000, mercatorY(60) - 1000, 150});
  EXPECT_NEAR(local.x, 500, 1.5);
  EXPECT_NEAR(local.y, -500, 1.5);
  EXPECT_EQ(local.z, 50);
  EXPECT_NEAR(frame->toSource(local).x, 1e6 + 1000, 1e-8);

  stateMapScale(g, {1e6, 0});
  EXPECT_FALSE(g.mapScale) << "nearly true at the equator";
  Georeference utm = test::georeferenceOf("EPSG:32611");
  stateMapScale(utm, {300000, 4e6});
  EXPECT_FALSE(utm.mapScale);
  Georeference flat = test::georeferenceOf("EPSG:4087");
  stateMapScale(flat, {0, 60 * kRadiansPerDegree * kA});
  ASSERT_TRUE(flat.mapScale);
  EXPECT_NEAR((*flat.mapScale)[0], 2, 0.01) << "only parallels are stretched";
  EXPECT_NEAR((*flat.mapScale)[1], 1, 0.01);
  Georeference degrees = test::georeferenceOf("EPSG:4326");
  stateMapScale(degrees, {10, 60});
  EXPECT_FALSE(degrees.mapScale);
}

}  // namespace
}  // namespace arete
