// SPDX-License-Identifier: GPL-3.0-or-later
//
// Maps of a sphere, whose geodesics are closed formulas: every sample against its own great circle.
#include "terrain/viewshed/azimuthal_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "datasets/random.h"

namespace arete::test {
namespace {

constexpr double kRadius = 6371000, kDegrees = 180 / std::numbers::pi;

/// A plan of longitudes and latitudes, row 0 in the north.
class Sphere final : public SightEarth {
 public:
  Sphere(double north, double step) : north_(north), step_(step) {}

  Result<SightTrack> track(Vec2 from, Vec2 to) const override {
    if (to.x > reach) return failure(ErrorCode::invalidData, "is out of reach");
    const double lon = (to.x - from.x) * step_ / kDegrees, lat0 = latitude(from), lat1 = latitude(to);
    const double east = std::cos(lat1) * std::sin(lon),
                 north = std::cos(lat0) * std::sin(lat1) - std::sin(lat0) * std::cos(lat1) * std::cos(lon),
                 up = std::sin(lat0) * std::sin(lat1) + std::cos(lat0) * std::cos(lat1) * std::cos(lon);
    SightTrack track;
    track.points = {{from, 0}, {to, kRadius * std::atan2(std::hypot(east, north), up)}};
    track.azimuthDegrees = kDegrees * std::atan2(east, north);
    track.curvature = track.groundCurvature = 1 / kRadius;
    return track;
  }
  std::optional<double> geodesicError() const override {
    return isGeodesic ? std::optional(1e-3) : std::nullopt;
  }

  bool isGeodesic = true;
  double reach = 1e9;

 private:
  double latitude(Vec2 p) const { return (north_ - p.y * step_) / kDegrees; }
  double north_, step_;
};

constexpr std::uint32_t kColumns = 300, kRows = 210;

TEST(AzimuthalMap, HasTheDistanceAndAzimuthOfEverySample) {
  constexpr std::uint64_t kSeed = 141;
  Random random(kSeed);
  for (const double north : {47.0, 0.5, -33.0}) {
    const Sphere sphere(north, 1.0 / 1200);
    const Vec2 observer{random.between(3, kColumns - 4), random.between(3, kRows - 4)};
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", north " << north << ", observer " << observer.x
                                    << ", " << observer.y);
    const auto map = AzimuthalMap::make(sphere, observer, kColumns, kRows, {});
    ASSERT_TRUE(map) << map.error();
    EXPECT_LT(map->planError(0), 0.02);
    EXPECT_LE(map->planError(0), map->planError(1000));
    EXPECT_LE(map->leastCurvature, 1 / kRadius);
    EXPECT_GE(map->mostCurvature, 1 / kRadius);
    double worst = 0;
    for (int i = 0; i < 3000; ++i) {
      const int column = int(random.below(kColumns + 2)) - 1, row = int(random.below(kRows + 2)) - 1;
      double x, y, twiceDrop;
      map->along(true, column, row, 1, &x, &y, &twiceDrop);
      const auto track = sphere.track(observer, {double(column), double(row)});
      const double s = track->points[1].distance, a = track->azimuthDegrees / kDegrees;
      const SightEarth::PlaneSteps& steps = map->steps;
      const double east = x * steps.x.x + y * steps.y.x, norths = x * steps.x.y + y * steps.y.y;
      const double off = std::hypot(east - s * std::sin(a), norths - s * std::cos(a)) /
                         std::min(std::hypot(steps.x.x, steps.x.y), std::hypot(steps.y.x, steps.y.y));
      worst = std::max(worst, off);
      EXPECT_LE(off, map->planError(0)) << column << ", " << row;
      EXPECT_NEAR(twiceDrop, s * s / kRadius, map->heightError(0)) << column << ", " << row;
      const double dx = column - observer.x, dy = row - observer.y;
      if (std::hypot(dx, dy) > 4) {
        EXPECT_LE(std::fabs(std::atan2(y * dx - x * dy, x * dx + y * dy)), map->turn);
      }
      // A row has the same samples.
      double rx, ry, rd;
      map->along(false, row, column, 1, &rx, &ry, &rd);
      EXPECT_NEAR(rx, x, 1e-9);
      EXPECT_NEAR(ry, y, 1e-9);
    }
    RecordProperty("worst deviation in steps", std::to_string(worst));
  }
}

TEST(AzimuthalMap, IsTheSameForAnyNumberOfThreads) {
  const Sphere sphere(60, 1.0 / 600);
  std::vector<double> first;
  for (const int threads : {1, 2, 4, 3}) {
    RunContext context;
    context.threads = threads;
    const auto map = AzimuthalMap::make(sphere, {100, 90}, kColumns, kRows, context);
    ASSERT_TRUE(map);
    std::vector<double> all{map->turn,           map->planError(0),   map->planError(50),
                            map->planError(1e9), map->heightError(0), map->heightError(1e4),
                            map->leastCurvature, map->mostCurvature,  map->curvatureError()};
    for (int row = -1; row <= int(kRows); ++row) {
      std::vector<double> line(3 * (kColumns + 2));
      map->along(false, row, -1, kColumns + 2, line.data(), line.data() + kColumns + 2,
                 line.data() + 2 * (kColumns + 2));
      all.insert(all.end(), line.begin(), line.end());
    }
    if (first.empty()) first = all;
    EXPECT_EQ(all, first) << threads << " threads";
  }
}

TEST(AzimuthalMap, IsRefusedWithAReason) {
  Sphere sphere(47, 1.0 / 1200);
  const auto whyNot = [&](const Sphere& of) {
    const auto map = AzimuthalMap::make(of, {50, 50}, 100, 100, {});
    return map ? std::string() : map.error();
  };
  EXPECT_EQ(whyNot(sphere), "");
  sphere.isGeodesic = false;
  EXPECT_NE(whyNot(sphere), "");
  sphere.isGeodesic = true;
  sphere.reach = 80;
  EXPECT_NE(whyNot(sphere), "");
  EXPECT_NE(whyNot(Sphere(89.9, 1.0 / 1200)), "");  // near the pole
  EXPECT_NE(whyNot(Sphere(60, 0.4)), "");           // 40 degrees wide
}

}  // namespace
}  // namespace arete::test
