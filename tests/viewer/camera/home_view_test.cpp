// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/camera/home_view.h"

#include <gtest/gtest.h>

#include <algorithm>

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

}  // namespace
}  // namespace arete
