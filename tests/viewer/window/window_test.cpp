// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/window.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <set>

#include "viewer/camera_models.h"
#include "viewer/gl/terrain_drawable.h"
#include "viewer/under_xvfb.h"

namespace arete {
namespace {

const TerrainModel& northernView() {
  return test::cameraModels()[0].model;
}

FillScene terrain(const TerrainModel& model) {
  return [&model](Scene& scene) -> Status {
    ARETE_TRY(TerrainDrawable made, TerrainDrawable::create(model, {}));
    return scene.add(std::make_unique<TerrainDrawable>(std::move(made)));
  };
}

struct Folder {
  std::filesystem::path path;
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "arete-window-XXXXXX").string();
    path = mkdtemp(pattern.data());
  }
  ~Folder() { std::filesystem::remove_all(path); }
};

TEST(Window, ShowsTheTerrainAndThePanelAndAnswersWhatIsAsked) {
  ARETE_UNDER_XVFB("");
  const Folder folder;
  WindowOptions options{.title = "test", .samples = 1, .waitsForScreen = false};
  options.lastPicture = folder.path / "window.png";
  std::uint32_t triangles = 0;
  options.onFrame = [&](ViewerSession& s, int frame) {
    triangles = std::max(triangles, s.figures.triangles);
    const Vec2 middle{s.rig.camera().widthPixels / 2, s.rig.camera().heightPixels / 2};
    if (frame == 1) s.click(middle);
    if (frame == 2) s.click({middle.x + 40, middle.y + 10});
    if (frame == 3) {
      EXPECT_EQ(s.tools->picks.size(), 2u);
      EXPECT_TRUE(s.tools->sight);
      s.say(s.tools->startViewshed());
    }
    for (const Action action : {Action::wireframe, Action::contours, Action::help, Action::colorError})
      if (frame == 4) s.apply(action);
    if (frame == 5) s.isFrozen = true;
    if (frame == 6) s.apply(Action::nextHome);
    if (frame == 7) s.settings.path = CutPath::processor;
    if (frame == 8) s.settings.stretch = 2;
    // On, until the viewshed is there.
    return frame < 10 || (s.tools->viewshed.isRunning() && frame < 2000);
  };
  const Status shown = runWindow(terrain(northernView()), options);
  ASSERT_TRUE(shown) << shown.error().describe();
  EXPECT_GT(triangles, 2u);
  EXPECT_GT(std::filesystem::file_size(options.lastPicture), 10000u) << "an empty picture is smaller";
}

TEST(Window, RendersAFlightIntoAFolderOfFrames) {
  ARETE_UNDER_XVFB("");
  const Folder folder;
  WindowOptions options{.title = "test", .width = 640, .height = 480, .samples = 1, .waitsForScreen = false};
  options.start.settings.path = CutPath::processor;
  bool isAsked = false;
  options.onFrame = [&](ViewerSession& s, int frame) {
    if (frame == 0) {
      FlightPlan plan;
      plan.keys = {s.rig.camera(), s.rig.camera()};
      plan.keys[1].azimuthDegrees += 10;
      plan.framesPerSecond = 5;
      plan.duration = 1;
      s.deck.setPlan(plan);
      s.files.framesFolder = folder.path / "frames";
      s.files.wantsFrames = isAsked = true;
      return true;
    }
    return s.files.wantsFrames && frame < 200;
  };
  const Status shown = runWindow(terrain(northernView()), options);
  ASSERT_TRUE(shown) << shown.error().describe();
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path / "frames"))
    names.insert(entry.path().filename().string());
  EXPECT_GE(names.size(), 3u);
  EXPECT_TRUE(names.contains("frame_00000.png"));
}

TEST(Window, GoesBackFromWhereACurvedEarthCannotBeSeen) {
  ARETE_UNDER_XVFB("");
  const RasterFamily& family = rasterFamilies()[2];
  for (const bool isKnown : {true, false}) {
    SCOPED_TRACE(isKnown ? "a camera beyond the pole" : "an unknown CRS");
    TerrainModel model = test::modelOn(family, {10, 0.001, 0, 60.015, 0, -0.001}, true);
    if (isKnown) model.georeference.crsWkt = "EPSG:4326";
    WindowOptions options{
        .title = "test", .width = 320, .height = 240, .samples = 1, .waitsForScreen = false};
    options.start.settings.isCurved = isKnown;
    bool isChecked = false;
    options.onFrame = [&](ViewerSession& s, int frame) {
      if (frame == 2) {
        s.rig.setFloorMetres(0);
        Camera beyond = s.rig.camera();
        beyond.xy.y = 95;
        if (isKnown) s.rig.place(beyond);
        s.settings.isCurved = true;
      }
      if (frame == 4) {
        EXPECT_NE(s.message().find(isKnown ? "CRS" : "curvature"), std::string::npos) << s.message();
        EXPECT_EQ(s.settings.isCurved, isKnown);
        EXPECT_LT(s.rig.camera().xy.y, 61);
        isChecked = true;
      }
      return frame < 5;
    };
    const Status shown = runWindow(terrain(model), options);
    EXPECT_TRUE(shown) << shown.error().describe();
    EXPECT_TRUE(isChecked);
  }
}

TEST(Window, AnOpenGlBelow45IsASentenceThatNamesIt) {
  ARETE_UNDER_XVFB("MESA_GL_VERSION_OVERRIDE=3.3");
  const Status shown = runWindow(terrain(northernView()), {.title = "test", .frames = 1});
  ASSERT_FALSE(shown);
  EXPECT_EQ(shown.error().code, ErrorCode::unsupported);
  EXPECT_NE(shown.error().message.find("OpenGL 4.5 is needed"), std::string::npos) << shown.error().message;
  EXPECT_NE(shown.error().message.find("3.3"), std::string::npos) << shown.error().message;
}

TEST(Window, NoDisplayIsASentence) {
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  const Status shown = runWindow(terrain(northernView()), {.title = "test", .frames = 1});
  ASSERT_FALSE(shown);
  EXPECT_EQ(shown.error().code, ErrorCode::unsupported);
  EXPECT_NE(shown.error().describe().find("display"), std::string::npos) << shown.error().describe();
}

TEST(Window, WhatGoesWrongBeforeTheFirstFrameClosesItWithItsReason) {
  ARETE_UNDER_XVFB("");
  WindowOptions options{.title = "test", .frames = 3};
  const Status shown = runWindow(
      [](Scene&) -> Status { return failure(ErrorCode::invalidData, "does not overlap", "drape"); }, options);
  ASSERT_FALSE(shown);
  EXPECT_EQ(shown.error().describe(), "drape: does not overlap");
}

}  // namespace
}  // namespace arete
