// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface in the window's session: what moves its camera, its flights, and what is for terrain.
#include "viewer/surface/surface_subject.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "surface/builder/build.h"
#include "surface/families.h"
#include "viewer/drawn_mesh.h"
#include "viewer/headless/headless.h"
#include "viewer/surface/surface_drawable.h"
#include "viewer/under_xvfb.h"
#include "viewer/window/window.h"

namespace arete {
namespace {

const SurfaceModel& ball() {
  static const SurfaceModel model = std::move(*buildSurface(SurfaceMesh(shapes::globe(30, 20))));
  return model;
}

FillScene surface(const SurfaceModel& model) {
  return [&model](Scene& scene) -> Status {
    ARETE_TRY(SurfaceDrawable made,
              SurfaceDrawable::create(model, std::make_shared<SurfaceSubject>(model, ZUpFrame(model))));
    return scene.add(std::make_unique<SurfaceDrawable>(std::move(made)));
  };
}

class SurfaceSession : public testing::Test {
 protected:
  const SurfaceSubject subject_{ball(), ZUpFrame(ball())};
  Layers layers_;
  ViewerSession s_{subject_,
                   layers_,
                   {.picture = {.widthPixels = 400, .heightPixels = 300},
                    .settings = {.look = {.coloring = Coloring::material}}}};

  double distanceToMiddle() const { return norm(CameraSpace().position(s_.rig.camera())); }
};

TEST_F(SurfaceSession, DraggingTurnsAroundTheMiddle) {
  const Camera before = s_.rig.camera();
  const double distance = distanceToMiddle();
  InputState input;
  input.leftButton = true;
  input.mouseMoved = {50, 20};
  s_.step(input);
  EXPECT_NE(s_.rig.camera().azimuthDegrees, before.azimuthDegrees);
  EXPECT_NEAR(distanceToMiddle(), distance, 0.1);  // it looks a little beside it
}

TEST_F(SurfaceSession, TheWheelComesNearerAndTheRightButtonMoves) {
  const double before = distanceToMiddle();
  InputState wheel;
  wheel.wheel = 2;
  s_.step(wheel);
  EXPECT_LT(distanceToMiddle(), 0.8 * before);
  const Look look = lookOf(s_.rig.camera());
  InputState drag;
  drag.rightButton = true;
  drag.mouseMoved = {30, 0};
  s_.step(drag);
  EXPECT_EQ(lookOf(s_.rig.camera()).azimuthDegrees, look.azimuthDegrees);
  EXPECT_GT(distanceToMiddle(), 0);
}

TEST_F(SurfaceSession, HomeViewsFollowEachOtherAndCloseTheRound) {
  const Camera first = s_.rig.camera();
  for (std::size_t i = 0; i < kHomeViews.size(); ++i) s_.apply(Action::nextHome);
  EXPECT_NEAR(s_.rig.camera().xy.x, first.xy.x, 1e-9);
  EXPECT_NEAR(s_.rig.camera().height, first.height, 1e-9);
}

TEST_F(SurfaceSession, TwoClicksMeasureADistanceInTheUnitOfTheFile) {
  s_.home(HomeView::fromSouth);
  s_.click({200, 150});
  ASSERT_EQ(s_.distance.picks().size(), 1u);
  s_.click({220, 150});
  ASSERT_EQ(s_.distance.picks().size(), 2u);
  const auto& picks = s_.distance.picks();
  EXPECT_NEAR(norm(s_.distance.way()), norm(picks[1].inObject - picks[0].inObject), 1e-12);
  EXPECT_GT(norm(s_.distance.way()), 0);
  EXPECT_NE(layers_.find(DistancePicks::kLayer), nullptr);
  s_.apply(Action::clearPicks);
  EXPECT_TRUE(s_.distance.picks().empty());
  EXPECT_EQ(layers_.find(DistancePicks::kLayer), nullptr);
}

TEST_F(SurfaceSession, WhatIsForTerrainIsRefusedByName) {
  const Camera before = s_.rig.camera();
  for (const auto& [action, sentence] : {std::pair{Action::contours, "contours are for terrain"},
                                         {Action::follow, "following the ground is"},
                                         {Action::colorSlope, "colours by slope are"},
                                         {Action::colorAspect, "colours by aspect are"}}) {
    s_.apply(action);
    EXPECT_NE(s_.message().find(sentence), std::string::npos) << s_.message();
  }
  s_.goTo("1,2", false);
  EXPECT_NE(s_.message().find("for terrain"), std::string::npos) << s_.message();
  EXPECT_TRUE(layers_.list().empty());
  EXPECT_EQ(s_.settings.look.coloring, Coloring::material);
  EXPECT_EQ(s_.rig.camera().xy, before.xy);
  s_.apply(Action::geomorph);
  EXPECT_FALSE(s_.settings.isGeomorphed);
  s_.apply(Action::wireframe);
  EXPECT_TRUE(s_.settings.look.hasWireframe);
  s_.apply(Action::colorPlain);
  EXPECT_EQ(s_.settings.look.coloring, Coloring::plain);
  s_.apply(Action::colorUsual);
  EXPECT_EQ(s_.settings.look.coloring, Coloring::material);
}

TEST_F(SurfaceSession, LooksAndLayersOfTerrainAreRefusedByName) {
  ViewSettings settings{.look = {.coloring = Coloring::slope}};
  EXPECT_EQ(subject_.check(settings).error().describe(), "colour by slope: is for terrain");
  settings.look.coloring = Coloring::material;
  EXPECT_TRUE(subject_.check(settings));
  settings.stretch = 2;
  EXPECT_EQ(subject_.check(settings).error().describe(), "exaggeration: is for terrain");
  settings.stretch = 1;
  settings.isCurved = true;
  EXPECT_EQ(subject_.check(settings).error().describe(), "the Earth's curvature: is for terrain");
  EXPECT_EQ(subject_.check(Layer{.name = "lines", .content = Contours{}}).error().describe(),
            "lines: contours are for terrain");
  EXPECT_TRUE(subject_.check(Layer{.name = "lines", .content = SpaceVertices{}}));
}

TEST_F(SurfaceSession, AFlightIsSetPlayedAndKeptInAFile) {
  s_.files.flight =
      std::filesystem::temp_directory_path() / ("arete-surface-" + std::to_string(::getpid()) + ".json");
  s_.apply(Action::setKeyFrame);
  s_.home(HomeView::fromWest);
  s_.apply(Action::setKeyFrame);
  s_.apply(Action::saveFlight);
  s_.deck.clear();
  s_.apply(Action::loadFlight);
  ASSERT_EQ(s_.deck.plan().keys.size(), 2u) << s_.message();
  std::filesystem::remove(s_.files.flight);
  s_.apply(Action::playFlight);
  ASSERT_TRUE(s_.deck.isPlaying()) << s_.message();
  InputState still;
  still.seconds = 0.25;
  for (int i = 0; i < 100000 && s_.deck.isPlaying(); ++i) s_.step(still);
  EXPECT_NEAR(s_.rig.camera().azimuthDegrees, 90, 1e-6);
}

TEST_F(SurfaceSession, OneTurnKeepsTheMiddleInTheMiddleAndComesBack) {
  const Camera from = s_.rig.camera();
  const auto plan = subject_.round(from);
  ASSERT_TRUE(plan) << plan.error().describe();
  const auto flight = Flight::create(*plan, subject_.space());
  ASSERT_TRUE(flight);
  EXPECT_NEAR(flight->duration(), 8, 1e-9);
  const auto middle = pixelOf(subject_, from, subject_.box().centre());
  ASSERT_TRUE(middle);
  for (double t = 0; t <= 8; t += 0.37) {
    const auto seen = pixelOf(subject_, flight->at(t), subject_.box().centre());
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->x, middle->x, 0.5) << t;
    EXPECT_NEAR(seen->y, middle->y, 0.5) << t;
  }
  EXPECT_NEAR(flight->at(8).xy.x, from.xy.x, 1e-9);
  const Camera above = subject_.home(HomeView::fromAbove, from);
  EXPECT_TRUE(subject_.round(above)) << "which turns on the spot, or nearly";
}

TEST(SurfaceTurn, KeepsALongShapeInThePictureAllTheWay) {
  SurfaceMesh mesh(shapes::globe(30, 20));
  for (Vec3& p : mesh.positions) p.x *= 4, p.z *= 2;
  const SurfaceModel model = std::move(*buildSurface(SurfaceMesh(mesh)));
  const SurfaceSubject subject(model, ZUpFrame(model));
  const Camera picture{.widthPixels = 320, .heightPixels = 240};
  for (const HomeView home : {HomeView::fromWest, HomeView::fromSouth, HomeView::overview}) {
    const Camera from = subject.home(home, picture);
    const auto plan = subject.round(from);
    ASSERT_TRUE(plan) << plan.error().describe();
    const auto flight = Flight::create(*plan, subject.space());
    ASSERT_TRUE(flight);
    for (double t = 0; t <= 8; t += 0.37)
      for (const Vec3& p : mesh.positions) {
        const auto seen = pixelOf(subject, flight->at(t), p);
        ASSERT_TRUE(seen) << t;
        EXPECT_TRUE(seen->x >= 0 && seen->x <= 320 && seen->y >= 0 && seen->y <= 240) << toString(home) << t;
      }
  }
  // Who stands near chose to.
  Camera near = subject.home(HomeView::fromSouth, picture);
  near.xy.y /= 2;
  const auto plan = subject.round(near);
  ASSERT_TRUE(plan);
  EXPECT_NEAR(plan->keys.front().xy.y, near.xy.y, 1e-9);
}

TEST_F(SurfaceSession, AFilmOfASurfaceTakesThePathOfATerrains) {
  ARETE_NEEDS_OPENGL(probe);
  HeadlessOptions options{.widthPixels = 80, .heightPixels = 60, .samples = 1, .settings = s_.settings};
  options.settings.maxTriangles = 200;
  Result<HeadlessView> view = HeadlessView::create(options, surface(ball()));
  ASSERT_TRUE(view) << view.error().describe();
  const auto flight = Flight::create(*subject_.round(s_.rig.camera()), subject_.space());
  const auto folder = std::filesystem::temp_directory_path() / ("arete-turn-" + std::to_string(::getpid()));
  const auto frames = drawFilm(*view, *flight, {.folder = folder, .framesPerSecond = 0.5});
  std::filesystem::remove_all(folder);
  ASSERT_TRUE(frames) << frames.error().describe();
  ASSERT_EQ(frames->size(), 4u);
  for (const FilmFrame& frame : *frames) {
    EXPECT_TRUE(frame.figures.isShown);
    EXPECT_LE(frame.figures.triangles, 200u);
  }
}

TEST(SurfaceWindow, OpensDrawsTakesKeysAndSavesItsLastPicture) {
  ARETE_UNDER_XVFB("");
  const auto picture =
      std::filesystem::temp_directory_path() / ("arete-surface-" + std::to_string(::getpid()) + ".png");
  WindowOptions options{.width = 640, .height = 400, .samples = 1};
  options.start.settings.look.coloring = Coloring::material;
  options.lastPicture = picture;
  options.onFrame = [](ViewerSession& s, int frame) {
    const std::array actions = {Action::colorSlope, Action::help,     Action::setKeyFrame,
                                Action::toggleMode, Action::nextHome, Action::setKeyFrame};
    if (frame < int(actions.size())) s.apply(actions[std::size_t(frame)]);
    return frame < 8;
  };
  const Status shown = runWindow(surface(ball()), options);
  ASSERT_TRUE(shown) << shown.error().describe();
  EXPECT_TRUE(std::filesystem::exists(picture));
  std::filesystem::remove(picture);
}

}  // namespace
}  // namespace arete
