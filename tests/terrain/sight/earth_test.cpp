// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/sight/earth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "datasets/random.h"

namespace arete::test {
namespace {

TerrainModel rasterModel() {
  TerrainModel model;
  model.columns = 40;
  model.rows = 30;
  return model;
}

TEST(PlaneEarth, TracksAreStraightAndAsLongAsTheirSteps) {
  constexpr std::uint64_t kSeed = 61;
  Random random(kSeed);
  const TerrainModel model = rasterModel();
  const auto earth = makePlaneEarth(model);
  const auto steps = earth->planeSteps();
  ASSERT_TRUE(steps);
  EXPECT_FALSE(earth->geodesicError());
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", pair " << i);
    const Vec2 a{random.between(0, 39), random.between(0, 29)},
        b{random.between(0, 39), random.between(0, 29)};
    const auto track = earth->track(a, b);
    ASSERT_TRUE(track);
    const double x = b.x - a.x, y = b.y - a.y;
    const double east = x * steps->x.x + y * steps->y.x, north = x * steps->x.y + y * steps->y.y;
    ASSERT_EQ(track->points.size(), 2u);
    EXPECT_NEAR(track->points[1].distance, std::hypot(east, north), 1e-9);
    EXPECT_EQ(track->curvature, 0);
    const double radians = track->azimuthDegrees * std::acos(-1.0) / 180;
    EXPECT_NEAR(std::sin(radians) * track->points[1].distance, east, 1e-9);
    EXPECT_NEAR(std::cos(radians) * track->points[1].distance, north, 1e-9);
    EXPECT_GE(track->azimuthDegrees, 0);
    EXPECT_LT(track->azimuthDegrees, 360);
    EXPECT_EQ(*earth->distance(a, b), track->points[1].distance);
  }
}

TEST(PlaneEarth, PutsEndsOnLatticeLinesThatTheyAreNear) {
  const TerrainModel model = rasterModel();
  EXPECT_EQ(sightEnd(model, {3 + 1e-10, 4.5}).x, 3);
  EXPECT_EQ(sightEnd(model, {3 + 1e-6, 4.5}).x, 3 + 1e-6);
  EXPECT_EQ(sightEnd(model, {3 + 1e-6, 4.5}, 1e-5).x, 3);
  EXPECT_EQ(sightEnd(model, {3, 4.5}).y, 4.5);
  TerrainModel points;
  points.isRaster = false;
  EXPECT_EQ(sightEnd(points, {3 + 1e-10, 4}).x, 3 + 1e-10);
  const auto track = makePlaneEarth(model)->track({1 - 1e-11, 2}, {1 + 1e-11, 2});
  ASSERT_TRUE(track);
  EXPECT_EQ(track->points[1].distance, 0);
}

/// An Earth whose tracks fail beyond a column.
class HalfEarth final : public SightEarth {
 public:
  Result<SightTrack> track(Vec2 from, Vec2 to) const override {
    if (to.x > 10) return failure(ErrorCode::invalidData, "is out of reach");
    SightTrack track;
    track.points = {{from, 0}, {to, 12}};
    return track;
  }
};

TEST(SightEarth, HasTheDistanceOfATrackWhereThereIsOne) {
  EXPECT_EQ(HalfEarth().distance({0, 0}, {5, 0}), 12);
  EXPECT_FALSE(HalfEarth().distance({0, 0}, {15, 0}));
  EXPECT_FALSE(HalfEarth().planeSteps());
}

}  // namespace
}  // namespace arete::test
