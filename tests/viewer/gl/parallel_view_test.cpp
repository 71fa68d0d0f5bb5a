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

using test::DrawnMesh;
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
    auto device = view->cut(camera, settings);
    ASSERT_TRUE(device);
    DrawnMesh a = test::readDrawn(*view);
    settings.path = CutPath::processor;
    auto processor = view->cut(camera, settings);
    ASSERT_TRUE(processor) << processor.error().describe();
    DrawnMesh b = test::readDrawn(*view);
    EXPECT_EQ(device->moving, processor->moving);
    const auto sorted = [](DrawnMesh& mesh) {
      for (auto& t : mesh.triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      std::sort(mesh.triangles.begin(), mesh.triangles.end());
      return mesh.triangles;
    };
    ASSERT_EQ(sorted(a), sorted(b));
    drawn += a.triangles.size();
    for (const auto& t : a.triangles)
      for (const std::uint32_t v : t) ASSERT_NEAR(a.vertices[v].z, b.vertices[v].z, 2e-3) << "vertex " << v;
  }
  EXPECT_GT(drawn, 1000u);
}

// The pixel in column x of a picture from straight above shows the easting of its middle, and the depth there
// is the eye's height less the ground's.
TEST(ParallelPictures, FromStraightAboveAreTheResampledRaster) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel& model = mountains();
  Result<TerrainDrawable> view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  const GroundHeights ground(model);
  const TerrainSubject subject(model);
  Random random(5);
  for (int i = 0; i < 4; ++i) {
    SCOPED_TRACE("seed 5, picture " + std::to_string(i));
    Camera camera;
    camera.xy =
        model.toSource({model.columns * random.between(0.3, 0.7), model.rows * random.between(0.3, 0.7)});
    // Also below the ground, which the eye then has behind it.
    camera.height = i % 2 ? test::highest(model) + 500 : -700;
    camera.pitchDegrees = -90;
    camera.widthPixels = 240, camera.heightPixels = 160;
    camera.parallelHeight = random.between(800, 2400);
    ViewSettings settings;
    settings.pixels = 1e-6;  // the finest triangles
    settings.isGeomorphed = false;
    const double perPixel = camera.parallelHeight / 160;
    ASSERT_TRUE(view->cut(camera, settings));
    const auto target = FrameTarget::create(240, 160);
    ASSERT_TRUE(target);
    target->begin();
    ASSERT_TRUE(view->draw(camera, settings));
    const auto frame = view->frameOf(camera, settings);
    ASSERT_TRUE(frame);
    const std::vector<float> depths = target->depths(frame->drawnNear, frame->depthReach);
    // What the depth buffer and the positions, which are floats, allow.
    const double slack = 1e-3 + frame->depthReach * 2e-6;
    std::size_t compared = 0;
    for (int y = 0; y < 160; ++y)
      for (int x = 0; x < 240; ++x) {
        const Vec2 place{camera.xy.x + (x + 0.5 - 120) * perPixel, camera.xy.y - (y + 0.5 - 80) * perPixel};
        const auto there = ground.at(place);
        const float depth = depths[std::size_t(y) * 240 + std::size_t(x)];
        if (!there) continue;
        ++compared;
        ASSERT_TRUE(std::isfinite(depth)) << x << ", " << y;
        // A rasteriser takes corners to 1/256 of a pixel, which tilts thin triangles a little more.
        double off = slack;
        for (const Vec2 step : {Vec2{1, 0}, Vec2{-1, 0}, Vec2{0, 1}, Vec2{0, -1}})
          if (const auto beside = ground.at(place + (perPixel / 64) * step))
            off = std::max(off, slack + std::abs(beside->height - there->height));
        ASSERT_NEAR(camera.height - double(depth), there->height, off) << x << ", " << y;
        if (x % 40 != 7 || y % 40 != 9) continue;
        const auto pick = subject.pick(camera, {x + 0.5, y + 0.5}, settings);
        ASSERT_TRUE(pick);
        EXPECT_NEAR(pick->xy.x, place.x, 1e-6);
        EXPECT_NEAR(pick->xy.y, place.y, 1e-6);
        EXPECT_NEAR(pick->height, there->height, 1e-6);
        EXPECT_NEAR(pick->metres, norm(pick->metric - subject.space().position(camera)), 1e-6);
      }
    EXPECT_GT(compared, 10000u);
  }
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
