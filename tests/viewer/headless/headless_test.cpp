// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/headless/headless.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <atomic>
#include <filesystem>

#include "datasets/terrain_generator.h"
#include "terrain/builder/build.h"
#include "terrain/locate/ground_height.h"
#include "viewer/camera/home_view.h"
#include "viewer/camera/round_flight.h"
#include "viewer/drawn_mesh.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

/// A folder that goes with the test.
struct Folder {
  Folder() : path(fs::temp_directory_path() / ("arete-headless-" + std::to_string(::getpid()))) {
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  fs::path path;
};

TerrainModel mountains() {
  TerrainOptions options;
  options.columns = options.rows = 97;
  RasterHeightfield field = *generateTerrain(options);
  field.georeference = {};
  field.georeference.geoTransform = {0, 30, 0, 2000, 0, -30};
  field.georeference.hasGeoTransform = true;
  Result<TerrainModel> model = build(field);
  EXPECT_TRUE(model);
  return std::move(*model);
}

Camera overview(const TerrainModel& model) {
  return cameraOnAll(CameraSpace(model), homeShape(metricBox(model)), {0, -30});
}

TEST(Headless, ABudgetIsUsedNearlyWhollyAndSaidToBindByEitherPath) {
  ARETE_NEEDS_OPENGL(probe);
  const TerrainModel model = mountains();
  for (const CutPath path : {CutPath::device, CutPath::processor}) {
    SCOPED_TRACE(path == CutPath::device ? "device" : "processor");
    HeadlessOptions options{.widthPixels = 320, .heightPixels = 240, .samples = 1, .settings = {}};
    options.settings.path = path;
    options.settings.pixels = 0.01;
    options.settings.maxTriangles = 1000;
    Result<HeadlessView> view = HeadlessView::create(model, options);
    ASSERT_TRUE(view) << view.error().describe();
    const auto figures = view->draw(overview(model));
    ASSERT_TRUE(figures);
    EXPECT_LE(figures->triangles, 1000u);
    EXPECT_GE(figures->triangles, 900u);
    EXPECT_FALSE(figures->isComplete);
    EXPECT_GT(figures->pixels, 0.01);
  }
}

TEST(Headless, APictureSaysWhetherItShowsTheTerrain) {
  ARETE_NEEDS_OPENGL(probe);
  const TerrainModel model = mountains();
  Result<HeadlessView> view =
      HeadlessView::create(model, {.widthPixels = 160, .heightPixels = 90, .samples = 4, .settings = {}});
  ASSERT_TRUE(view) << view.error().describe();
  Camera camera = overview(model);
  EXPECT_TRUE(view->draw(camera)->isShown);
  camera.pitchDegrees = 60;
  EXPECT_FALSE(view->draw(camera)->isShown);
  camera = overview(model);
  camera.xy.x += 1e6;
  EXPECT_FALSE(view->draw(camera)->isShown);
  EXPECT_TRUE(view->draw(overview(model))->isShown);
}

TEST(Headless, APictureHasDecorationsWhereTheyAreWantedAndTheColoursOfItsLegend) {
  ARETE_NEEDS_OPENGL(probe);
  const TerrainModel model = mountains();
  HeadlessOptions options{.widthPixels = 800, .heightPixels = 450, .samples = 4, .settings = {}};
  options.settings.look.isShaded = false;
  Result<HeadlessView> plain = HeadlessView::create(model, options);
  ASSERT_TRUE(plain) << plain.error().describe();
  ASSERT_TRUE(plain->draw(overview(model)));
  const Image before = plain->image();
  EXPECT_EQ(plain->picture()->pixels, before.pixels) << "none is wanted";
  options.decorations = Decorations();
  Result<HeadlessView> view = HeadlessView::create(model, options);
  ASSERT_TRUE(view && view->draw(overview(model)));
  const Result<Image> picture = view->picture();
  ASSERT_TRUE(picture) << picture.error().describe();
  EXPECT_EQ(view->image().pixels, before.pixels);
  std::size_t changed = 0;
  for (std::size_t i = 0; i < before.pixels.size(); ++i)
    changed += picture->pixels[i] == before.pixels[i] ? 0 : 1;
  EXPECT_GT(changed, before.pixels.size() / 50);
  EXPECT_LT(changed, before.pixels.size() / 3);
}

TEST(Headless, AFilmHasAFrameForEveryMomentAndItsFigures) {
  ARETE_NEEDS_OPENGL(probe);
  const TerrainModel model = mountains();
  const GroundHeights heights(model);
  const CameraSpace space(model);
  const auto plan = roundFlight(heights, space, metricBox(model), {.durationSeconds = 2});
  ASSERT_TRUE(plan) << plan.error().describe();
  const auto flight = Flight::create(*plan, space);
  ASSERT_TRUE(flight);
  HeadlessOptions options{.widthPixels = 160, .heightPixels = 90, .samples = 1, .settings = {}};
  Result<HeadlessView> view = HeadlessView::create(model, options);
  ASSERT_TRUE(view);
  const Folder folder;
  const auto frames = drawFilm(*view, *flight, {.folder = folder.path / "frames", .framesPerSecond = 4});
  ASSERT_TRUE(frames) << frames.error().describe();
  ASSERT_EQ(frames->size(), 8u);  // a closed flight ends where it begins
  for (const FilmFrame& frame : *frames) {
    EXPECT_TRUE(fs::exists(frame.file)) << frame.file;
    EXPECT_GT(frame.figures.triangles, 0u);
    EXPECT_TRUE(frame.figures.isComplete);
  }
  EXPECT_EQ(fs::path(frames->back().file).filename(), "frame_00007.png");
}

TEST(Headless, AnInterruptedFilmLeavesWholeFramesOnly) {
  ARETE_NEEDS_OPENGL(probe);
  const TerrainModel model = mountains();
  const GroundHeights heights(model);
  const CameraSpace space(model);
  const auto plan = roundFlight(heights, space, metricBox(model), {.durationSeconds = 2});
  ASSERT_TRUE(plan);
  const auto flight = Flight::create(*plan, space);
  ASSERT_TRUE(flight);
  Result<HeadlessView> view =
      HeadlessView::create(model, {.widthPixels = 160, .heightPixels = 90, .samples = 1, .settings = {}});
  ASSERT_TRUE(view);
  const Folder folder;
  std::atomic<bool> stops = false;
  RunContext context;
  context.cancel = &stops;
  context.progress = [&](std::string_view, double done) { stops = stops || done > 0.3; };
  const auto frames = drawFilm(*view, *flight, {.folder = folder.path, .framesPerSecond = 4}, context);
  ASSERT_FALSE(frames);
  EXPECT_EQ(frames.error().code, ErrorCode::interrupted);
  for (const auto& file : fs::directory_iterator(folder.path)) EXPECT_EQ(file.path().extension(), ".png");
}

TEST(Headless, APictureLargerThanTheDeviceDrawsIsRefusedInASentence) {
  ARETE_NEEDS_OPENGL(probe);
  const TerrainModel model = mountains();
  const auto view =
      HeadlessView::create(model, {.widthPixels = 1 << 20, .heightPixels = 10, .samples = 1, .settings = {}});
  ASSERT_FALSE(view);
  EXPECT_EQ(view.error().code, ErrorCode::usage);
  EXPECT_NE(view.error().describe().find("1048576 x 10"), std::string::npos) << view.error().describe();
}

}  // namespace
}  // namespace arete
