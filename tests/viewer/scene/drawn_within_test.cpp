// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuts for cameras, triangle by triangle: what is drawn over a picked place is no farther from it than is
// said.
#include "viewer/scene/drawn_within.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "io/query/face/arete.h"
#include "viewer/camera_models.h"
#include "viewer/scene/terrain_subject.h"

namespace arete {
namespace {

const ViewSettings kAtRest{.isGeomorphed = false};

/// The height of a mesh at a place of the plan, by barycentric coordinates of each triangle.
std::optional<double> heightOf(const SurfaceMesh& mesh, Vec2 at) {
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.positions[std::size_t(t[0])], b = mesh.positions[std::size_t(t[1])],
               c = mesh.positions[std::size_t(t[2])];
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (area == 0) continue;
    const double v = ((at.x - a.x) * (c.y - a.y) - (c.x - a.x) * (at.y - a.y)) / area;
    const double w = ((b.x - a.x) * (at.y - a.y) - (at.x - a.x) * (b.y - a.y)) / area;
    constexpr double kEdge = 1e-9;
    if (v >= -kEdge && w >= -kEdge && v + w <= 1 + kEdge) return a.z + v * (b.z - a.z) + w * (c.z - a.z);
  }
  return std::nullopt;
}

TEST(DrawnWithin, WhatIsDrawnOverAPickedPlaceIsNoFartherFromIt) {
  std::uint64_t seed = 900;
  double closest = 0;
  for (const RasterFamily& family : rasterFamilies()) {
    const TerrainModel model = test::modelOn(family, {500000, 30, 0, 4000000, 0, -30});
    const TerrainSubject subject(model);
    Random random(++seed);
    for (int i = 0; i < 4; ++i) {
      Camera camera = subject.home(HomeView::overview, {.widthPixels = 400, .heightPixels = 300}, {});
      camera.height += random.between(-0.4, 0.4) * subject.box().diagonal();
      camera.azimuthDegrees = random.between(-20, 20);
      const double pixels = std::pow(10, random.between(-0.5, 1.2));
      const auto tin = cut(model, {.camera = camera, .pixelError = pixels});
      ASSERT_TRUE(tin) << tin.error().describe();
      for (int k = 0; k < 60; ++k) {
        const auto pick = subject.pick(camera, {random.between(0, 400), random.between(0, 300)});
        if (!pick) continue;
        const double within = drawnWithin(subject, camera, kAtRest, pixels, *pick);
        const auto drawn = heightOf(tin->mesh, pick->xy);
        ASSERT_TRUE(drawn) << family.name << ", seed " << seed;
        const double off = std::abs(*drawn - pick->height);
        EXPECT_LE(off, within * (1 + 1e-9) + 1e-9 * (1 + std::abs(pick->height)))
            << family.name << ", seed " << seed << ", pick " << k;
        if (within > 0) closest = std::max(closest, off / within);
      }
    }
  }
  EXPECT_GT(closest, 0.1) << "and it is not said for safety's sake";
}

TEST(DrawnWithin, MovingVerticesTakeAThirdOfTheTolerance) {
  const TerrainModel& model = test::cameraModels()[0].model;
  const TerrainSubject subject(model);
  const Camera camera = subject.home(HomeView::fromAbove, {}, {});
  const auto pick = subject.pick(camera, {960, 540});
  ASSERT_TRUE(pick);
  // The eye looks straight down: a pixel is as large on the ground as its distance makes it. So fine a cut
  // has the finest triangles, and only their motion is left.
  const double metres = 1e-3 * pick->metres * 2 *
                        std::tan(camera.verticalFieldOfViewDegrees / 2 * 0.0174532925) / camera.heightPixels;
  const double height = metres / subject.space().metresPerHeight();
  EXPECT_EQ(drawnWithin(subject, camera, kAtRest, 1e-3, *pick), 0);
  EXPECT_NEAR(drawnWithin(subject, camera, {}, 1e-3, *pick), height / 3, 1e-3 * height);
}

TEST(DrawnWithin, IsThatOfAnyCutWhereTheCameraOfTheCutDoesNotLook) {
  const TerrainModel& model = test::cameraModels()[0].model;
  const TerrainSubject subject(model);
  const Camera camera = subject.home(HomeView::fromAbove, {}, {});
  const auto pick = subject.pick(camera, {960, 540});
  ASSERT_TRUE(pick);
  Camera away = camera;
  away.pitchDegrees = 90;
  const double any = drawnWithin(subject, away, kAtRest, 0.01, *pick);
  EXPECT_EQ(any, drawnWithin(subject, camera, kAtRest, INFINITY, *pick));
  EXPECT_GT(any, drawnWithin(subject, camera, kAtRest, 0.01, *pick));
  EXPECT_EQ(drawnWithin(subject, camera, kAtRest, 1e-9, *pick), 0) << "the finest triangles";
}

TEST(DrawnWithin, IsSmallerWhereHeightsAreDrawnHigher) {
  const TerrainModel& model = test::cameraModels()[0].model;
  const TerrainSubject subject(model);
  const Camera camera = subject.home(HomeView::fromAbove, {}, {});
  const auto pick = subject.pick(camera, {960, 540});
  ASSERT_TRUE(pick);
  // From the same place in the space that is drawn, nearly.
  double before = INFINITY;
  for (const double stretch : {1.0, 4.0, 16.0, 64.0}) {
    const Camera higher = subject.home(HomeView::fromAbove, {}, {.stretch = stretch});
    const double within = drawnWithin(subject, higher, {.stretch = stretch}, 2, *pick);
    EXPECT_LE(within, before);
    before = within;
  }
}

TEST(DrawnWithin, ItsTextIsRoundedUpToTwoDigits) {
  for (const auto& [bound, text] : {std::pair{0.0, "0"},
                                    {0.123, "0.13"},
                                    {0.1, "0.10"},
                                    {1.0, "1.0"},
                                    {1.01, "1.1"},
                                    {9.95, "10.0"},
                                    {42.0, "42"},
                                    {42.1, "43"},
                                    {1234.0, "1300"},
                                    {0.00456, "0.0046"}})
    EXPECT_EQ(boundText(bound), text) << bound;
}

}  // namespace
}  // namespace arete
