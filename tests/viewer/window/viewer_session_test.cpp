// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/viewer_session.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "terrain/viewshed/viewshed.h"
#include "viewer/camera_models.h"
#include "viewer/viewed_terrain.h"

namespace arete {
namespace {

const TerrainModel& northUp() {
  return test::cameraModels()[0].model;
}

InputState still(double seconds = 0.02) {
  InputState in;
  in.seconds = seconds;
  return in;
}

/// Pixels of the picture that have terrain, from its middle outwards.
std::vector<Vec2> onTerrain(const ViewerSession& s) {
  std::vector<Vec2> pixels;
  for (double away = 0; away < 200; away += 13)
    for (const Vec2 d : {Vec2{1, 0}, Vec2{0, 1}, Vec2{-1, 0}, Vec2{0, -1}}) {
      const Vec2 pixel{400 + away * d.x, 300 + away * d.y};
      if (s.subject.pick(s.rig.camera(), pixel, {})) pixels.push_back(pixel);
    }
  return pixels;
}

/// Moves the camera a little, so that it is not at rest.
void fly(ViewerSession& s, int frame) {
  Camera camera = s.rig.camera();
  camera.xy.x += frame % 2 == 0 ? 1 : -1;
  s.rig.place(camera);
}

TEST(Session, KeysShowTheMarksEachByItselfAndChangeTheProjection) {
  test::ViewedTerrain viewed(northUp());
  ViewerSession& s = viewed.session;
  const auto has = [&](const char* name) { return s.layers.find(name) != nullptr; };
  const std::vector<std::pair<Action, const char*>> marks = {{Action::axes, SpaceMarks::kAxes},
                                                             {Action::grid, SpaceMarks::kGrid},
                                                             {Action::orbitMark, SpaceMarks::kOrbit}};
  for (const auto& [action, name] : marks) {
    s.apply(action);
    s.step(still());
    for (const auto& [other, otherName] : marks) EXPECT_EQ(has(otherName), other == action) << otherName;
    s.apply(action);
    s.step(still());
    EXPECT_FALSE(has(name));
  }
  // Free flight turns about nothing.
  s.apply(Action::orbitMark);
  s.apply(Action::toggleMode);
  s.step(still());
  EXPECT_FALSE(has(SpaceMarks::kOrbit));
  s.apply(Action::parallel);
  EXPECT_GT(s.rig.camera().parallelHeight, 0);
  s.apply(Action::parallel);
  EXPECT_EQ(s.rig.camera().parallelHeight, 0);
  s.settings.isCurved = true;
  s.apply(Action::parallel);
  EXPECT_EQ(s.rig.camera().parallelHeight, 0) << "a curved Earth is drawn in perspective";
}

TEST(Session, TheMarkOfAnOrbitIsWhereTheCameraTurnsAboutWhateverTheExaggeration) {
  test::ViewedTerrain viewed(northUp());
  ViewerSession& s = viewed.session;
  for (const double stretch : {1.0, 3.0}) {
    s.settings.stretch = stretch;
    s.step(still());
    // What is orbited is in the middle of the picture.
    const auto pixel = pixelOf(s.subject, s.rig.camera(), s.rig.orbitCentre(), s.settings);
    ASSERT_TRUE(pixel.has_value());
    EXPECT_NEAR(pixel->x, s.rig.camera().widthPixels / 2, 0.01);
    EXPECT_NEAR(pixel->y, s.rig.camera().heightPixels / 2, 0.01);
  }
}

TEST(Session, TheTargetTimeMakesTheToleranceCoarserAndLetsItFinerAgain) {
  test::ViewedTerrain viewed(northUp());
  ViewerSession& s = viewed.session;
  s.wanted.frameMilliseconds = 16;
  // A device that takes 20 ms for a pixel and half of it for two.
  for (int i = 0; i < 400; ++i) {
    s.figures.pixels = s.settings.pixels;
    s.history.add(40 / s.settings.pixels, 40);
    fly(s, i);
    s.step(still());
  }
  EXPECT_LE(40 / s.settings.pixels, 16 * 1.25);
  EXPECT_GE(40 / s.settings.pixels, 16 * 0.7);
  s.wanted.frameMilliseconds = 0;
  for (int i = 0; i < 400; ++i) {
    fly(s, i);
    s.step(still());
  }
  EXPECT_DOUBLE_EQ(s.settings.pixels, 1);
}

TEST(Session, TheTargetTimeGrowsWhileTheCameraRestsAndTheFirstMotionEndsThat) {
  test::ViewedTerrain viewed(northUp());
  ViewerSession& s = viewed.session;
  s.wanted.frameMilliseconds = 16;
  const auto frame = [&] {
    s.figures.pixels = s.settings.pixels;
    s.history.add(40 / s.settings.pixels, 40);
    s.step(still());
  };
  for (int i = 0; i < 200; ++i) {
    fly(s, i);
    frame();
  }
  const double flying = s.settings.pixels;
  EXPECT_GT(flying, 2);
  // 400 frames of rest: what takes 40 ms is drawn with the tolerance that is wanted.
  for (int i = 0; i < 400; ++i) frame();
  EXPECT_DOUBLE_EQ(s.settings.pixels, 1);
  fly(s, 1);
  frame();
  EXPECT_NEAR(s.settings.pixels, flying, 0.3 * flying);
}

TEST(Session, DecorationsAreShownAndHiddenByTheirKey) {
  test::ViewedTerrain viewed(northUp());
  EXPECT_TRUE(viewed.session.shows.decorations);
  viewed.session.apply(Action::decorations);
  EXPECT_FALSE(viewed.session.shows.decorations);
  ViewerSession::Start plain;
  plain.showsDecorations = false;
  test::ViewedTerrain without(northUp(), plain);
  EXPECT_FALSE(without.session.shows.decorations);
}

TEST(Session, AFrozenCutKeepsItsCameraWhileTheOtherFliesOn) {
  test::ViewedTerrain viewed(northUp());
  ViewerSession& s = viewed.session;
  s.apply(Action::freeze);
  s.step(still());
  ASSERT_TRUE(s.frozen);
  const double height = s.frozen->height;
  s.rig.home(HomeView::fromAbove);
  s.step(still());
  EXPECT_EQ(s.frozen->height, height);
  EXPECT_NE(s.rig.camera().height, height);
  s.apply(Action::freeze);
  s.step(still());
  EXPECT_FALSE(s.frozen);
}

TEST(Session, TwoClicksMakeALineOfSightAndAThirdBeginsAnew) {
  test::ViewedTerrain viewed(northUp());
  ViewerSession& s = viewed.session;
  s.rig.setPicture(800, 600);
  const std::vector<Vec2> pixels = onTerrain(s);
  ASSERT_GE(pixels.size(), 3u);
  s.click(pixels.front());
  ASSERT_EQ(s.tools->picks.size(), 1u);
  EXPECT_FALSE(s.tools->sight);
  s.click(pixels.back());
  ASSERT_EQ(s.tools->picks.size(), 2u);
  ASSERT_TRUE(s.tools->sight);
  EXPECT_FALSE(s.tools->sight->text.empty());
  // The line begins and ends above the picks, by what was asked for.
  const double up = s.tools->observerAbove * s.subject.space().metresPerHeight();
  EXPECT_NEAR(s.tools->sight->points.front().z, s.tools->picks[0].metric.z + up, 1e-6);
  EXPECT_NEAR(s.tools->sight->points.back().x, s.tools->picks[1].metric.x, 1e-6);
  EXPECT_EQ(s.tools->sight->obstruction.has_value(),
            s.tools->sight->answer.sight.verdict == SightVerdict::blocked);
  s.tools->observerAbove = s.tools->targetAbove = 1e5;
  s.tools->updateSight();
  EXPECT_EQ(s.tools->sight->answer.sight.verdict, SightVerdict::visible);
  s.click(pixels[1]);
  EXPECT_EQ(s.tools->picks.size(), 1u);
  EXPECT_FALSE(s.tools->sight);
  s.click({2, 2});
  EXPECT_EQ(s.tools->picks.size(), 1u) << "the sky is no place";
}

TEST(Session, AViewshedFromAPickIsThatOfTheMaker) {
  test::ViewedTerrain viewed(northUp());
  ViewerSession& s = viewed.session;
  s.rig.setPicture(800, 600);
  s.say(s.tools->startViewshed());
  EXPECT_FALSE(s.message().empty()) << "there is no pick yet";
  const std::vector<Vec2> pixels = onTerrain(s);
  ASSERT_FALSE(pixels.empty());
  s.click(pixels.front());
  ASSERT_EQ(s.tools->picks.size(), 1u);
  s.say(s.tools->startViewshed());
  for (int i = 0; i < 3000 && s.tools->viewshed.isRunning(); ++i) {
    s.step(still());
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_TRUE(s.tools->overlay) << s.message();
  const auto maker = ViewshedMaker::make(s.tools->model(), s.tools->sights.earth());
  ASSERT_TRUE(maker);
  ViewshedOptions options;
  options.targetHeight = s.tools->targetAbove;
  const auto viewshed = maker->from(
      {sightPlan(s.tools->model(), s.tools->picks[0].xy), s.tools->picks[0].height + s.tools->observerAbove},
      options);
  ASSERT_TRUE(viewshed);
  EXPECT_EQ(s.tools->overlay->seen, viewshed->seen);
  ASSERT_EQ(s.tools->overlay->picture->rgba.size(), viewshed->cells.size());
  // Of every sample the pixel that the texture has in its place.
  const PlanPicture& o = *s.tools->overlay->picture;
  for (std::uint32_t row = 0; row < viewshed->rows; ++row)
    for (std::uint32_t column = 0; column < viewshed->columns; ++column) {
      const int x = int(std::floor((column * o.scale.x + o.shift.x) * o.width));
      const int y = int(std::floor((row * o.scale.y + o.shift.y) * o.height));
      const auto& pixel = o.rgba[std::size_t(y) * std::size_t(o.width) + std::size_t(x)];
      const bool isSeen =
          viewshed->cells[std::size_t(row) * viewshed->columns + column] == ViewshedCell::seen;
      ASSERT_EQ(pixel[0] == 255, isSeen) << column << ", " << row;
    }
  s.apply(Action::clearPicks);
  EXPECT_FALSE(s.tools->overlay);
}

TEST(Session, AFlightIsSetPlayedStoppedByAHandAndKeptInAFile) {
  test::ViewedTerrain viewed(northUp());
  ViewerSession& s = viewed.session;
  s.apply(Action::playFlight);
  EXPECT_FALSE(s.message().empty()) << "a flight without key frames is a sentence";
  EXPECT_FALSE(s.deck.isPlaying());
  s.apply(Action::setKeyFrame);
  const Camera first = s.rig.camera();
  s.apply(Action::playFlight);
  EXPECT_FALSE(s.deck.isPlaying()) << "one key frame is no flight";
  s.rig.home(HomeView::fromWest);
  s.apply(Action::setKeyFrame);
  s.apply(Action::playFlight);
  ASSERT_TRUE(s.deck.isPlaying()) << s.message();
  s.step(still(0.5));
  EXPECT_NE(s.rig.camera().xy.x, first.xy.x);
  InputState hand = still();
  hand.turnRight = 1;
  s.step(hand);
  EXPECT_FALSE(s.deck.isPlaying());
  s.apply(Action::playFlight);
  for (int i = 0; i < 100000 && s.deck.isPlaying(); ++i) s.step(still(0.25));
  EXPECT_FALSE(s.deck.isPlaying()) << "it ends by itself";
  EXPECT_NEAR(s.rig.camera().azimuthDegrees, 90, 1e-6);

  s.files.flight = std::filesystem::temp_directory_path() / "arete-window-flight.json";
  s.apply(Action::saveFlight);
  s.deck.clear();
  s.apply(Action::loadFlight);
  EXPECT_EQ(s.deck.plan().keys.size(), 2u) << s.message();
  std::filesystem::remove(s.files.flight);
  s.apply(Action::loadFlight);
  EXPECT_NE(s.message().find("flight.json"), std::string::npos) << "a file that is not there is named";
  EXPECT_EQ(s.deck.plan().keys.size(), 2u);
}

TEST(Session, GoToLooksAtAPlaceOrStandsAtAPosition) {
  test::ViewedTerrain viewed(northUp());
  ViewerSession& s = viewed.session;
  s.rig.setPicture(800, 600);
  s.rig.setFloorMetres(0);
  const Vec2 xy = s.tools->model().toSource({20, 15});
  s.goTo(std::to_string(xy.x) + "," + std::to_string(xy.y), false);
  EXPECT_TRUE(s.message().empty()) << s.message();
  const auto seen = s.subject.pick(s.rig.camera(), {400, 300}, {});
  ASSERT_TRUE(seen);
  EXPECT_LE(seen->metres, 2000 + 1e-6);
  s.goTo(std::to_string(xy.x) + ", " + std::to_string(xy.y) + ", 5000msl", false);
  EXPECT_NEAR(s.rig.camera().height, 5000, 1e-6);
  EXPECT_NEAR(s.rig.camera().xy.x, xy.x, 1e-6);
  for (const char* nonsense : {"", "1", "a,b", "1,2", "1,2,3,4", "1,2,3xyz"}) {
    const Camera before = s.rig.camera();
    s.goTo(nonsense, false);
    EXPECT_FALSE(s.message().empty()) << nonsense;
    EXPECT_EQ(s.rig.camera().height, before.height);
  }
}

TEST(Session, GoToFindsALongitudeThatIsWholeTurnsOff) {
  const TerrainModel& geographic = test::cameraModels()[5].model;
  ASSERT_TRUE(geographic.georeference.isGeographic);
  test::ViewedTerrain viewed(geographic);
  ViewerSession& s = viewed.session;
  s.rig.setFloorMetres(0);
  const Vec2 xy = geographic.toSource({20, 15});
  for (const double turns : {-1.0, 0.0, 1.0, 2.0}) {
    SCOPED_TRACE(turns);
    const std::string place = std::to_string(xy.x + 360 * turns) + "," + std::to_string(xy.y);
    const auto goal = s.tools->places.read(place, false);
    ASSERT_TRUE(goal) << goal.error().describe();
    EXPECT_NEAR(goal->xy.x, xy.x, 1e-6);
    s.goTo(place + ",5000msl", false);
    EXPECT_NEAR(s.rig.camera().xy.x, xy.x, 1e-6);
  }
}

TEST(Session, ContourIntervalsAreRoundAndAboutADozen) {
  for (double range = 0.013; range < 1e5; range *= 1.37) {
    const double interval = usualContourInterval(range);
    EXPECT_GE(range / interval, 7);
    EXPECT_LE(range / interval, 21.1);
    const double lead = interval / std::pow(10, std::floor(std::log10(interval) + 1e-9));
    EXPECT_TRUE(std::abs(lead - 1) < 1e-6 || std::abs(lead - 2) < 1e-6 || std::abs(lead - 5) < 1e-6)
        << interval;
  }
  EXPECT_EQ(usualContourInterval(0), 1);
}

TEST(Session, TheEdgesOfAFrustumAreSeenAtTheCornersOfItsPicture) {
  for (const test::CameraModel& m : test::cameraModels()) {
    const TerrainSubject subject(m.model);
    const Camera camera = subject.home(HomeView::overview, {}, {});
    const SpaceVertices edges = frustumEdges(subject.space(), camera, 100, 2);
    ASSERT_EQ(edges.vertices.size(), 16u);
    for (std::size_t i = 1; i < 16; i += 4) {
      const auto seen = pixelOf(subject, camera, edges.vertices[i].place, {.stretch = 2});
      ASSERT_TRUE(seen);
      EXPECT_NEAR(std::min(seen->x, camera.widthPixels - seen->x), 0, 1e-4);
      EXPECT_NEAR(std::min(seen->y, camera.heightPixels - seen->y), 0, 1e-4);
    }
  }
}

/// A folder that goes with the test.
struct SessionFolder {
  std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "arete_session_test";
  SessionFolder() {
    std::filesystem::remove_all(path);
    std::filesystem::create_directories(path);
  }
  ~SessionFolder() { std::filesystem::remove_all(path); }
};

TEST(Session, SavingAFlightAsksBeforeItOverwritesAndWaitsForTheAnswer) {
  const SessionFolder folder;
  test::ViewedTerrain viewed(northUp());
  ViewerSession& s = viewed.session;
  s.files.flight = folder.path / "flight.json";
  s.apply(Action::setKeyFrame);
  s.apply(Action::saveFlight);
  EXPECT_FALSE(s.question.isWaiting()) << "nothing is there yet";
  const auto size = std::filesystem::file_size(s.files.flight);
  s.rig.home(HomeView::fromAbove);
  s.apply(Action::setKeyFrame);
  s.apply(Action::saveFlight);
  ASSERT_TRUE(s.question.isWaiting());
  EXPECT_NE(s.question.sentence().find("flight.json exists"), std::string::npos) << s.question.sentence();
  EXPECT_EQ(std::filesystem::file_size(s.files.flight), size);
  s.step(still());
  s.answer(false);
  EXPECT_EQ(std::filesystem::file_size(s.files.flight), size);
  s.apply(Action::saveFlight);
  // The answer is about the file that was asked about, whatever the panel says by then.
  s.files.flight = folder.path / "another.json";
  s.answer(true);
  EXPECT_GT(std::filesystem::file_size(folder.path / "flight.json"), size);
  EXPECT_FALSE(std::filesystem::exists(folder.path / "another.json"));
  EXPECT_FALSE(s.question.isWaiting());
}

TEST(Session, FramesAskBeforeTheyOverwriteFrames) {
  const SessionFolder folder;
  test::ViewedTerrain viewed(northUp());
  ViewerSession& s = viewed.session;
  s.files.framesFolder = folder.path / "frames";
  s.toggleFrames();
  EXPECT_FALSE(s.files.wantsFrames) << "there is no flight";
  s.flyAround();
  s.toggleFrames();
  EXPECT_TRUE(s.files.wantsFrames);
  s.toggleFrames();
  EXPECT_FALSE(s.files.wantsFrames);
  std::filesystem::create_directories(folder.path / "frames");
  std::ofstream(folder.path / "frames" / "frame_00000.png") << "a frame";
  s.toggleFrames();
  EXPECT_FALSE(s.files.wantsFrames);
  EXPECT_NE(s.question.sentence().find("holds 1 frame"), std::string::npos) << s.question.sentence();
  s.answer(true);
  EXPECT_TRUE(s.files.wantsFrames);
}

TEST(Session, AHomeViewFillsWhatThePanelAndTheWindowLeaveUntilACameraMoves) {
  test::ViewedTerrain viewed(northUp(), {.picture = {.widthPixels = 800, .heightPixels = 600}});
  ViewerSession& s = viewed.session;
  s.rig.setPicture(800, 600);
  s.step(still());
  const auto isHome = [&] {
    const Camera home =
        s.subject.home(HomeView::overview, s.rig.camera(), {.stretch = s.settings.stretch}, s.covered);
    return home.xy.x == s.rig.camera().xy.x && home.xy.y == s.rig.camera().xy.y &&
           home.height == s.rig.camera().height;
  };
  EXPECT_TRUE(isHome());
  s.covered = {.left = 0.3};
  s.step(still());
  EXPECT_TRUE(isHome()) << "beside a panel";
  s.rig.setPicture(400, 700);
  s.step(still());
  EXPECT_TRUE(isHome()) << "in another window";
  s.settings.stretch = 3;
  s.step(still());
  EXPECT_TRUE(isHome()) << "with higher heights";
  InputState drag = still();
  drag.leftButton = true;
  drag.mouseMoved = {30, 0};
  s.step(drag);
  const Camera left = s.rig.camera();
  s.covered = {};
  s.rig.setPicture(800, 600);
  s.step(still());
  EXPECT_EQ(s.rig.camera().azimuthDegrees, left.azimuthDegrees) << "a view that was chosen stays";
  EXPECT_EQ(s.rig.camera().xy.x, left.xy.x);
}

TEST(Session, TheCursorReadsOnlyWhereTheMouseIsOverThePicture) {
  test::ViewedTerrain viewed(
      northUp(), {.home = HomeView::fromAbove, .picture = {.widthPixels = 800, .heightPixels = 600}});
  ViewerSession& s = viewed.session;
  s.rig.setPicture(800, 600);
  InputState in = still();
  in.mouse = {400, 300};
  s.step(in);
  EXPECT_EQ(s.cursor.text(), "");
  in.isOverPicture = true;
  s.step(in);
  EXPECT_NE(s.cursor.text().find("drawn"), std::string::npos) << s.cursor.text();
  const int asked = s.cursor.asked();
  for (int i = 0; i < 5; ++i) s.step(in);
  EXPECT_EQ(s.cursor.asked(), asked) << "a mouse at rest costs nothing";
}

}  // namespace
}  // namespace arete
