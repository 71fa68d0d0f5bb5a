// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/camera/home_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viewer/camera_models.h"

namespace arete {
namespace {

TEST(HomeView, HasTheWholeTerrainInThePictureAndFillsIt) {
  for (const auto& [name, model] : test::cameraModels()) {
    const CameraSpace space(model);
    const MetricBox box = metricBox(model);
    for (const HomeView view : kHomeViews)
      for (const auto& [width, height] : {std::pair{1920.0, 1080.0}, {600.0, 1300.0}, {800.0, 800.0}})
        for (const double field : {20.0, 60.0, 110.0}) {
          SCOPED_TRACE(name + " from " + std::string(toString(view)));
          const Camera camera =
              homeCamera(view, space, box,
                         {.verticalFieldOfViewDegrees = field, .widthPixels = width, .heightPixels = height});
          double most = 0;
          Vec2 low{1, 1}, high{-1, -1};
          for (const Vec3& corner : box.corners()) {
            const auto seen = test::inPicture(camera, corner, model);
            ASSERT_TRUE(seen);
            most = std::max({most, std::abs(seen->x), std::abs(seen->y)});
            low = {std::min(low.x, seen->x), std::min(low.y, seen->y)};
            high = {std::max(high.x, seen->x), std::max(high.y, seen->y)};
          }
          EXPECT_LE(most, 0.9 + 1e-6) << "all of it, with some room";
          EXPECT_GE(most, 0.9 - 1e-6) << "and no further away than that takes";
          EXPECT_NEAR(low.x, -high.x, 1e-6) << "in the middle";
          EXPECT_NEAR(low.y, -high.y, 1e-6);
          EXPECT_EQ(camera.widthPixels, width);
        }
  }
}

TEST(HomeView, HasEveryVertexInItsBox) {
  for (const RasterFamily& family : rasterFamilies()) {
    const TerrainModel model = test::modelOn(family, {0, 10, 3, 0, 2, -10});
    const MetricBox box = metricBox(model);
    const RasterHeightfield samples = model.rasterSamples();
    double lowest = INFINITY, highest = -INFINITY;
    for (std::uint32_t v = 0; v < model.mt.vertexCount(); ++v) {
      const Vec3 p = model.mt.arrays().metric.toMetric(model.mt.position(VertexId{v}));
      ASSERT_TRUE(p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y)
          << family.name;
      lowest = std::min(lowest, p.z);
      highest = std::max(highest, p.z);
    }
    EXPECT_EQ(lowest, box.low.z) << family.name;
    EXPECT_EQ(highest, box.high.z) << family.name;
  }
}

TEST(HomeView, LooksFromWhereItSays) {
  for (const auto& [name, model] : test::cameraModels()) {
    const CameraSpace space(model);
    const MetricBox box = metricBox(model);
    const Vec2 centre = space.xy(box.centre());
    EXPECT_GT(homeCamera(HomeView::fromNorth, space, box).xy.y, centre.y) << name;
    EXPECT_LT(homeCamera(HomeView::fromSouth, space, box).xy.y, centre.y) << name;
    EXPECT_GT(homeCamera(HomeView::fromEast, space, box).xy.x, centre.x) << name;
    EXPECT_LT(homeCamera(HomeView::fromWest, space, box).xy.x, centre.x) << name;
    EXPECT_GT(space.position(homeCamera(HomeView::overview, space, box)).z, box.high.z) << name;
    const Camera above = homeCamera(HomeView::fromAbove, space, box);
    EXPECT_EQ(above.pitchDegrees, -90);
    const Vec2 north = *test::inPicture(above, space.position({centre.x, centre.y + 1e-3}, 0), model);
    const Vec2 here = *test::inPicture(above, space.position(centre, 0), model);
    EXPECT_GT(north.y, here.y) << name << ": north is up";
  }
}

/// How far points reach in a picture, from -1 to 1 over its free part.
struct Reach {
  Vec2 low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
  bool isBehind = false;
  double nearest = INFINITY;  // metres

  void take(const std::optional<Vec2>& seen, const CoveredEdges& c) {
    if (!seen) {
      isBehind = true;
      return;
    }
    const auto part = [](double at, double atLow, double atHigh) {
      return (at - (atLow - atHigh)) / (1 - atLow - atHigh);
    };
    const Vec2 at{part(seen->x, c.left, c.right), part(seen->y, c.bottom, c.top)};
    low = {std::min(low.x, at.x), std::min(low.y, at.y)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y)};
  }
  double most() const { return std::max({-low.x, high.x, -low.y, high.y}); }
  bool touchesBothSides(double near) const {
    return (std::abs(high.x - 0.9) < near && std::abs(low.x + 0.9) < near) ||
           (std::abs(high.y - 0.9) < near && std::abs(low.y + 0.9) < near);
  }
};

Reach reachOf(const TerrainModel& model, const Camera& camera, double stretch, const CoveredEdges& covered) {
  // inPicture() knows no exaggeration: the camera and the points are moved instead.
  const CameraSpace space(model);
  const Vec3 eye = space.position(camera);
  const Camera drawn = space.at(camera, {eye.x, eye.y, eye.z * stretch});
  Reach reach;
  for (std::uint32_t v = 0; v < model.mt.vertexCount(); ++v) {
    Vec3 p = model.mt.arrays().metric.toMetric(model.mt.position(VertexId{v}));
    p.z *= stretch;
    reach.nearest = std::min(reach.nearest, dot(p - space.position(drawn), space.forward(lookOf(camera))));
    auto seen = test::inPicture(drawn, p, model);
    if (seen && model.isFlipped()) seen->x = -seen->x;  // the space is mirrored, and the picture is not
    reach.take(seen, covered);
  }
  return reach;
}

TEST(HomeView, OfTheRealShapeTouchesTheMarginsOnTwoSidesInEveryPicture) {
  std::vector<std::pair<std::string, TerrainModel>> models;
  for (const RasterFamily& family : rasterFamilies())
    models.emplace_back(family.name, test::modelOn(family, {500000, 30, 0, 4000000, 0, -30}));
  for (const PointFamily& family : pointFamilies()) {
    auto made = build(family.make(200, 3));
    ASSERT_TRUE(made);
    models.emplace_back(family.name, std::move(*made));
  }
  for (const auto& [name, model] : models) {
    const CameraSpace space(model);
    const HomeShape shape = homeShape(model);
    for (const HomeView view : kHomeViews)
      for (const auto& [width, height] : {std::pair{1280.0, 720.0}, {500.0, 1100.0}})
        for (const double stretch : {0.5, 6.0})
          for (const CoveredEdges& covered : {CoveredEdges{}, {.left = 0.3, .right = 0.1, .top = 0.05}}) {
            SCOPED_TRACE(name + " from " + std::string(toString(view)) + ", heights times " +
                         std::to_string(stretch) + ", " + std::to_string(int(width)) + " pixels wide");
            const Camera camera = homeCamera(
                view, space, shape, {.widthPixels = width, .heightPixels = height}, stretch, covered);
            const Reach reach = reachOf(model, camera, stretch, covered);
            EXPECT_FALSE(reach.isBehind);
            EXPECT_LE(reach.most(), 0.9 + 1e-6) << "all of it, with some room";
            EXPECT_TRUE(reach.touchesBothSides(1e-6) ||
                        reach.nearest < 0.021 * std::max(1.0, stretch) * shape.box.diagonal())
                << "and no further away than that takes";
            EXPECT_NEAR(reach.low.x, -reach.high.x, 1e-6) << "in the middle of what is free";
            EXPECT_NEAR(reach.low.y, -reach.high.y, 1e-6);
          }
  }
}

TEST(HomeView, AnOverviewLooksDownAsFarAsFillsTheHeightOfThePicture) {
  // A flat model fills a wide picture from steeply above only; a tower fills it as it stands.
  for (const auto& [name, height] : {std::pair{"flat", 0.0}, {"low", 0.4}, {"tower", 5.0}}) {
    const MetricBox box{{-1, -1, 0}, {1, 1, height}};
    const Camera picture{.widthPixels = 1600, .heightPixels = 900};
    const Camera camera = homeCamera(HomeView::overview, CameraSpace(), box, picture);
    Reach reach;
    const CameraSpace space;
    const Vec3 eye = space.position(camera);
    const PictureAxes axes = axesOf(space, lookOf(camera));
    const double slope = std::tan(camera.verticalFieldOfViewDegrees * std::numbers::pi / 360);
    for (const Vec3& corner : box.corners()) {
      const Vec3 d = corner - eye;
      const double depth = dot(d, axes.ahead);
      reach.take(Vec2{dot(d, axes.right) / (depth * slope * 16 / 9), dot(d, axes.up) / (depth * slope)}, {});
    }
    EXPECT_LE(reach.most(), 0.9 + 1e-6) << name;
    EXPECT_LE(camera.pitchDegrees, -30) << name;
    EXPECT_GE(camera.pitchDegrees, -60) << name;
    EXPECT_NEAR(reach.high.y, 0.9, 0.02) << name << " fills the height at " << camera.pitchDegrees;
    if (height > 1) {
      EXPECT_EQ(camera.pitchDegrees, -30) << name;
    }
  }
  const Camera upright = homeCamera(HomeView::overview, CameraSpace(), MetricBox{{-9, -1, 0}, {9, 1, 0}},
                                    {.widthPixels = 300, .heightPixels = 900});
  EXPECT_EQ(upright.pitchDegrees, -60) << "no look fills the height with that, and none is steeper";
}

TEST(HomeView, TheShapeOfManyVerticesLeavesOutLessThanAHundredthOfTheBox) {
  using Surface = Vec3 (*)(double, double);
  constexpr std::uint32_t kSide = 200;
  const std::pair<const char*, Surface> surfaces[] = {
      {"a sphere",
       [](double u, double v) {
         return Vec3{std::cos(6.3 * u) * std::sin(3.1 * v), std::sin(6.3 * u) * std::sin(3.1 * v),
                     std::cos(3.1 * v)};
       }},
      {"a shallow cone",
       [](double u, double v) {
         return Vec3{u, v, -std::hypot(u - 0.4, v - 0.6)};
       }},
      {"a diagonal strip",
       [](double u, double v) {
         return Vec3{u + 0.01 * v, u - 0.01 * v, 0.1 * u * u};
       }},
      {"a spike",
       [](double u, double v) {
         return Vec3{u, v, u == 0.5 && v == 0.5 ? 1.0 : 0.0};
       }},
      {"a plane",
       [](double u, double v) {
         return Vec3{u, v, 0.3 * u + 0.2 * v};
       }},
  };
  for (const auto& [name, surface] : surfaces) {
    std::vector<Vec3> all;
    for (std::uint32_t j = 0; j < kSide; ++j)
      for (std::uint32_t i = 0; i < kSide; ++i) all.push_back(surface(double(i) / kSide, double(j) / kSide));
    all.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});
    const HomeShape shape = homeShape(std::uint32_t(all.size()), [&](std::uint32_t v) { return all[v]; });
    all.pop_back();
    EXPECT_LT(shape.points.size(), all.size()) << name;
    Random random(11);
    for (int i = 0; i < 200; ++i) {
      const Vec3 d{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
      const auto farthest = [&](const std::vector<Vec3>& points) {
        double most = -INFINITY;
        for (const Vec3& p : points) most = std::max(most, dot(p, d));
        return most;
      };
      EXPECT_GE(farthest(shape.points), farthest(all) - 0.01 * shape.box.diagonal() * norm(d)) << name;
    }
  }
}

}  // namespace
}  // namespace arete
