// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures of a terrain whose pages come late: no hole, no crack, and within the tolerance when the camera
// stands still.
#include "viewer/pages/paged_drawable.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include "datasets/random.h"
#include "viewer/drawn_mesh.h"
#include "viewer/gl/frame_target.h"
#include "viewer/gl_mountains.h"

namespace arete {
namespace {

namespace fs = std::filesystem;
using test::anyCamera;
using test::mountains;

/// The mountains in a file in pages.
struct Paged {
  Paged() : path(fs::temp_directory_path() / ("arete-pages-" + std::to_string(::getpid()) + ".amt")) {
    EXPECT_TRUE(writeAmt(path.string(), mountains(), {}, {.isPaged = true}));
    const auto pages = openAmt(path.string())->pagesFor({});
    for (const PageNeed& need : *pages) bytes += need.bytes.size();
  }
  ~Paged() { fs::remove(path); }
  Result<PagedTerrain> drawable(std::uint64_t mostBytes, CutPath cut = CutPath::device) const {
    ARETE_TRY(AmtFile file, openAmt(path.string()));
    ARETE_TRY(TerrainPages pages, TerrainPages::open(std::move(file), mostBytes));
    auto subject = std::make_shared<PagedTerrainSubject>(pages.outline());
    return drawPaged(std::move(pages), std::move(subject), {.path = cut});
  }
  fs::path path;
  std::uint64_t bytes = 0;
};

ViewSettings plainLook(CutPath cut) {
  ViewSettings settings;
  settings.path = cut;
  settings.look.isShaded = false;
  return settings;
}

/// Straight from above, the whole terrain in the picture.
Camera fromAbove(double parallelHeight) {
  const TerrainModel& model = mountains();
  Camera camera{.xy = model.toSource({model.columns / 2.0, model.rows / 2.0}),
                .height = test::highest(model) + 2000,
                .pitchDegrees = -90,
                .widthPixels = 320,
                .heightPixels = 240};
  camera.parallelHeight = parallelHeight;
  return camera;
}

/// Pixels without terrain whose places, and those of the pixels around, are on the model.
int holesIn(const FrameTarget& target, const Drawable& drawable, const Camera& camera,
            const ViewSettings& settings) {
  const TerrainModel& model = mountains();
  const Image image = target.image();
  const auto frame = drawable.frameOf(camera, settings);
  const std::vector<float> depths = target.depths(frame->drawnNear, frame->depthReach);
  const double metres = camera.parallelHeight / camera.heightPixels;
  int holes = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const Vec2 at{camera.xy.x + (x + 0.5 - camera.widthPixels / 2) * metres,
                    camera.xy.y - (y + 0.5 - camera.heightPixels / 2) * metres};
      const Vec2 plan = model.toPlan(at);
      const double margin = 2 * metres / 30;
      if (plan.x < margin || plan.y < margin || plan.x > model.columns - 1 - margin ||
          plan.y > model.rows - 1 - margin)
        continue;
      if (!std::isfinite(depths[std::size_t(y) * std::size_t(image.width) + std::size_t(x)])) ++holes;
    }
  return holes;
}

TEST(PagedDrawable, LeavesNoHoleAndNoCrackWhilePagesAreLate) {
  ARETE_NEEDS_OPENGL(context);
  const Paged paged;
  const double area = (mountains().columns - 1.0) * (mountains().rows - 1.0);
  for (const CutPath cut : {CutPath::device, CutPath::processor}) {
    SCOPED_TRACE(cut == CutPath::device ? "device" : "processor");
    Result<PagedTerrain> drawable = paged.drawable(paged.bytes / 3, cut);
    ASSERT_TRUE(drawable) << drawable.error().describe();
    const auto target = FrameTarget::create(320, 240);
    ASSERT_TRUE(target);
    ViewSettings settings = plainLook(cut);
    settings.pageBytes = 3000;
    bool wasLate = false;
    for (int frame = 0; frame < 40; ++frame) {
      SCOPED_TRACE(frame);
      Camera camera = fromAbove(7000);
      camera.xy.x += 40.0 * frame;
      if (frame >= 20) camera.parallelHeight = 7000 - 250 * (frame - 20);
      ASSERT_TRUE(drawable->advance(camera, settings));
      const auto figures = drawable->cut(camera, settings);
      ASSERT_TRUE(figures) << figures.error().describe();
      ASSERT_TRUE(figures->pages);
      wasLate = wasLate || figures->pages->missingTriangles > 0;
      target->begin();
      ASSERT_TRUE(drawable->draw(camera, settings));
      const test::DrawnMesh mesh = test::readDrawn(drawable->shown());
      EXPECT_EQ(test::whyNotConforming(mesh), "");
      EXPECT_NEAR(test::planArea(mesh), area, 1e-3 * area);
      EXPECT_EQ(holesIn(*target, *drawable, camera, settings), 0);
    }
    EXPECT_TRUE(wasLate) << "no page was late, so that nothing was tested";
  }
}

TEST(PagedDrawable, IsWithinTheToleranceWhenTheCameraStandsStill) {
  ARETE_NEEDS_OPENGL(context);
  const Paged paged;
  Result<PagedTerrain> drawable = paged.drawable(paged.bytes);
  ASSERT_TRUE(drawable) << drawable.error().describe();
  Random random(9);
  for (int i = 0; i < 6; ++i) {
    SCOPED_TRACE("seed 9, camera " + std::to_string(i));
    const Camera camera = anyCamera(random, mountains(), 640, 400);
    ViewSettings settings = plainLook(CutPath::device);
    settings.pageBytes = 20'000;
    double pixels = 0;
    for (int frame = 0; frame < 60; ++frame) {
      ASSERT_TRUE(drawable->advance(camera, settings));
      const auto figures = drawable->cut(camera, settings);
      ASSERT_TRUE(figures);
      pixels = figures->pixels;
      if (figures->pages->missingTriangles == 0 && figures->pages->bytes == 0) break;
    }
    EXPECT_EQ(pixels, settings.pixels);
  }
}

TEST(PagedDrawable, DrawsWhatAWholeModelShowsOnceItsPagesAreThere) {
  ARETE_NEEDS_OPENGL(context);
  const Paged paged;
  Result<PagedTerrain> drawable = paged.drawable(paged.bytes);
  ASSERT_TRUE(drawable) << drawable.error().describe();
  Result<TerrainDrawable> whole = TerrainDrawable::create(mountains(), {});
  ASSERT_TRUE(whole);
  const auto target = FrameTarget::create(320, 200);
  ASSERT_TRUE(target);
  Random random(10);
  for (int i = 0; i < 8; ++i) {
    SCOPED_TRACE("seed 10, camera " + std::to_string(i));
    const Camera camera = anyCamera(random, mountains());
    ViewSettings settings = plainLook(CutPath::device);
    settings.pixels = 0.5;
    ASSERT_TRUE(drawable->advance(camera, settings));
    ASSERT_TRUE(drawable->cut(camera, settings));
    target->begin();
    ASSERT_TRUE(drawable->draw(camera, settings));
    const std::vector<float> ours = target->depths(0.1);
    ASSERT_TRUE(whole->cut(camera, settings));
    target->begin();
    ASSERT_TRUE(whole->draw(camera, settings));
    const std::vector<float> theirs = target->depths(0.1);
    std::size_t differ = 0;
    for (std::size_t k = 0; k < ours.size(); ++k)
      differ += std::isfinite(ours[k]) != std::isfinite(theirs[k]) ||
                        (std::isfinite(ours[k]) && std::abs(ours[k] - theirs[k]) > 0.02 * theirs[k])
                    ? 1
                    : 0;
    // Along silhouettes half a pixel of error shows what is behind.
    EXPECT_LT(differ, ours.size() / 50);
  }
}

TEST(PagedDrawable, ReadsInTheBackgroundWhereAPictureDoesNotWait) {
  ARETE_NEEDS_OPENGL(context);
  const Paged paged;
  Result<PagedTerrain> drawable = paged.drawable(paged.bytes);
  ASSERT_TRUE(drawable) << drawable.error().describe();
  const Camera camera = fromAbove(2000);
  ViewSettings settings = plainLook(CutPath::device);
  settings.waits = false;
  const auto target = FrameTarget::create(320, 240);
  ASSERT_TRUE(target);
  bool isThere = false;
  for (int frame = 0; frame < 2000 && !isThere; ++frame) {
    ASSERT_TRUE(drawable->advance(camera, settings));
    const auto figures = drawable->cut(camera, settings);
    ASSERT_TRUE(figures) << figures.error().describe();
    target->begin();
    ASSERT_TRUE(drawable->draw(camera, settings));
    ASSERT_EQ(holesIn(*target, *drawable, camera, settings), 0) << frame;
    isThere = figures->pixels == settings.pixels && figures->pages->missingPages == 0;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_TRUE(isThere);
}

TEST(PagedDrawable, RefusesWhatNeedsTheWholeModel) {
  ARETE_NEEDS_OPENGL(context);
  const Paged paged;
  Result<PagedTerrain> drawable = paged.drawable(paged.bytes);
  ASSERT_TRUE(drawable) << drawable.error().describe();
  ViewSettings settings = plainLook(CutPath::device);
  settings.isCurved = true;
  EXPECT_FALSE(drawable->cut(fromAbove(2000), settings));
  settings.isCurved = false;
  settings.look.coloring = Coloring::slope;
  EXPECT_FALSE(drawable->cut(fromAbove(2000), settings));
  EXPECT_EQ(drawable->subject().terrain(), nullptr) << "tools take heights of full resolution from it";
}

}  // namespace
}  // namespace arete
