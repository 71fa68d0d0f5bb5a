// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures in parallel projection. Places in the picture are computed by the formulas of a map.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "datasets/random.h"
#include "terrain/locate/ground_height.h"
#include "viewer/drawn_mesh.h"
#include "viewer/gl/frame_target.h"
#include "viewer/gl/terrain_drawable.h"
#include "viewer/gl_mountains.h"

namespace arete {
namespace {

using test::mountains;

Camera anyParallel(Random& random, int width, int height) {
  Camera camera = test::anyCamera(random, mountains(), width, height);
  camera.parallelHeight = random.between(300, 6000);
  camera.height = random.between(-2000, 4000);
  return camera;
}

TEST(ParallelPictures, BothPathsDrawTheSameSurface) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel& model = mountains();
  Result<TerrainDrawable> view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  Random random(18);
  std::size_t drawn = 0;
  for (int i = 0; i < 10; ++i) {
    SCOPED_TRACE("seed 18, camera " + std::to_string(i));
    const Camera camera = anyParallel(random, 1280, 720);
    ViewSettings settings;
    settings.pixels = random.between(0.5, 4);
    drawn += test::expectBothPathsAgree(*view, camera, settings);
  }
  EXPECT_GT(drawn, 1000u);
}

TEST(ParallelPictures, APickIsDrawnAtThePixelThatItWasTakenAt) {
  const TerrainModel& model = mountains();
  const TerrainSubject subject(model);
  Random random(77);
  std::size_t picked = 0;
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE("seed 77, camera " + std::to_string(i));
    const Camera camera = anyParallel(random, 640, 480);
    ViewSettings settings;
    settings.stretch = i % 2 ? 1 : 3;
    const Vec2 pixel{random.between(0, 640), random.between(0, 480)};
    const auto pick = subject.pick(camera, pixel, settings);
    if (!pick) continue;
    ++picked;
    const auto back = pixelOf(subject, camera, pick->metric, settings);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->x, pixel.x, 1e-3);
    EXPECT_NEAR(back->y, pixel.y, 1e-3);
    EXPECT_NEAR(subject.heights()->at(pick->xy)->height, pick->height, 1e-6);
  }
  EXPECT_GT(picked, 50u);
}

TEST(ParallelPictures, HomeViewsHaveAllInThePictureAndFillIt) {
  const TerrainSubject subject(mountains());
  for (const HomeView home : kHomeViews)
    for (const CoveredEdges& covered : {CoveredEdges{}, CoveredEdges{.left = 0.3, .bottom = 0.1}}) {
      SCOPED_TRACE(toString(home));
      Camera picture;
      picture.widthPixels = 800, picture.heightPixels = 500;
      picture.parallelHeight = 1;
      const Camera camera = subject.home(home, picture, {}, covered);
      Vec2 low{1e9, 1e9}, high{-1e9, -1e9};
      for (const Vec3& p : homeShape(mountains()).points) {
        const auto at = pixelOf(subject, camera, p, {});
        ASSERT_TRUE(at);
        low = {std::min(low.x, at->x), std::min(low.y, at->y)};
        high = {std::max(high.x, at->x), std::max(high.y, at->y)};
      }
      EXPECT_GE(low.x, 800 * covered.left);
      EXPECT_GE(low.y, 0);
      EXPECT_LE(high.x, 800);
      EXPECT_LE(high.y, 500 * (1 - covered.bottom));
      const double across = (high.x - low.x) / (800 * (1 - covered.left)),
                   upwards = (high.y - low.y) / (500 * (1 - covered.bottom));
      EXPECT_NEAR(std::max(across, upwards), 0.9, 1e-6);
    }
}

}  // namespace
}  // namespace arete
