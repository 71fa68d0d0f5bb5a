// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces beside terrain and each other: what hides what, which cut each has, what a pixel picks.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/criteria/view_error.h"
#include "engine/follow/incremental_cut.h"
#include "engine/morph/geomorph.h"
#include "surface/builder/build.h"
#include "surface/families.h"
#include "terrain/builder/build.h"
#include "viewer/drawn_mesh.h"
#include "viewer/gl/terrain_drawable.h"
#include "viewer/headless/headless.h"
#include "viewer/surface/surface_drawable.h"

namespace arete {
namespace {

SurfaceModel ballOf(double radius) {
  SurfaceMesh mesh(shapes::globe(48, 32));
  double size = 0;
  for (const Vec3& p : mesh.positions) size = std::max(size, norm(p));
  for (Vec3& p : mesh.positions) p = p * (radius / size);
  return std::move(*buildSurface(std::move(mesh)));
}

TerrainModel plain() {
  RasterHeightfield field;
  field.columns = field.rows = 21;
  field.heights.assign(441, 100);
  field.georeference.geoTransform = {1000, 10, 0, 2000, 0, -10};
  field.georeference.hasGeoTransform = true;
  return std::move(*build(field));
}

constexpr int kSide = 200;

ViewSettings unshaded() {
  ViewSettings settings;
  settings.look.isShaded = false;
  settings.look.coloring = Coloring::plain;
  return settings;
}

/// Balls of one surface on a plain, each about a place of the map.
struct BallsOnThePlain {
  TerrainModel terrain = plain();
  SurfaceModel ball = ballOf(1);
  std::shared_ptr<const TerrainSubject> ground = std::make_shared<const TerrainSubject>(terrain);
  std::shared_ptr<const SurfaceForm> form = std::make_shared<const SurfaceForm>(ball, ZUpFrame(ball));
  std::vector<std::shared_ptr<SurfaceSubject>> balls;

  void put(const Vec3& place, double radius, const Turn& turn = {}) {
    const Placement placement{
        .anchor = ground->space().position({place.x, place.y}, place.z), .turn = turn, .scale = radius};
    balls.push_back(std::make_shared<SurfaceSubject>(form, placement, ground.get()));
  }
  Result<HeadlessView> view(const ViewSettings& settings = unshaded()) const {
    return HeadlessView::create(
        {.widthPixels = kSide, .heightPixels = kSide, .samples = 1, .settings = settings},
        [&](Scene& scene) -> Status {
          ARETE_TRY(TerrainDrawable made, TerrainDrawable::create(ground, {}));
          ARETE_CHECK(scene.add(std::make_unique<TerrainDrawable>(std::move(made)), {.name = "plain"}));
          ARETE_TRY(const auto assets, SurfaceAssets::create(ball, form->upright));
          for (const auto& subject : balls)
            ARETE_CHECK(scene.add(std::make_unique<SurfaceDrawable>(assets, subject), {.name = "ball"}));
          return {};
        });
  }
};

Camera straightDown(const Vec3& over, double height) {
  return {.xy = {over.x, over.y},
          .height = height,
          .pitchDegrees = -90,
          .verticalFieldOfViewDegrees = 90,
          .widthPixels = kSide,
          .heightPixels = kSide};
}

const Rgb kGround{199, 199, 199};

TEST(SurfaceScene, ABallHalfInTheGroundShowsItsUpperHalfWhereItIs) {
  ARETE_NEEDS_OPENGL(probe);
  BallsOnThePlain scene;
  scene.put({1100, 1900, 100}, 20);
  scene.put({1150, 1880, 60}, 20);  // all of it below
  auto view = scene.view();
  ASSERT_TRUE(view) << view.error().describe();
  // A metre of the ground is a pixel.
  const auto figures = view->draw(straightDown({1100, 1900, 0}, 100 + kSide / 2));
  ASSERT_TRUE(figures) << figures.error().describe();
  const Image image = view->image();
  EXPECT_NE(image.at(100, 100), kGround);
  EXPECT_NE(image.at(100 + 17, 100), kGround);
  EXPECT_NE(image.at(100, 100 - 17), kGround);
  EXPECT_EQ(image.at(100 + 27, 100), kGround);
  EXPECT_EQ(image.at(150, 120), kGround) << "what is below the ground is hidden";
}

TEST(SurfaceScene, EachObjectHasTheCutOfItsOwnDistance) {
  ARETE_NEEDS_OPENGL(probe);
  BallsOnThePlain scene;
  scene.put({1100, 1900, 130}, 20);
  scene.put({1160, 1900, 110}, 5);
  auto view = scene.view();
  ASSERT_TRUE(view);
  const Camera camera = straightDown({1110, 1900, 0}, 260);
  ASSERT_TRUE(view->draw(camera));
  const auto& objects = view->scene().objects();
  // The same cuts from cameras that see a ball of radius 1 as the scene's sees its own.
  for (std::size_t i = 0; i < 2; ++i) {
    const SurfaceSubject& ball = *scene.balls[i];
    const View seen = viewedBy(ball.pose({}), *scene.ground->viewOf(camera, {}));
    IncrementalCut alone(scene.ball.mt);
    const View own = scene.form->upright.turnedBack(seen);
    const double pixels = MorphCamera({.view = own}, scene.ball.mt.metric()).tolerance().cut;
    ASSERT_TRUE(alone.update(ViewError({.view = own, .pixels = pixels}, scene.ball.mt.metric())));
    EXPECT_EQ(objects[1 + i].figures.triangles, alone.triangles().size());
    const Vec3 eye = Vec3{1110, 1900, 260} - ball.inFile(placed(ball.placement(), scene.ground.get())({}));
    EXPECT_GT(norm(eye), 0);
    // Lengths count in radii.
    const Vec3 centre = i == 0 ? Vec3{1100, 1900, 130} : Vec3{1160, 1900, 110};
    EXPECT_NEAR(norm(seen.eye), norm(Vec3{1110, 1900, 260} - centre) / (i == 0 ? 20 : 5), 1e-9);
  }
  EXPECT_GT(objects[1].figures.triangles, objects[2].figures.triangles);
}

TEST(SurfaceScene, APickIsTheNearestObjectInTheCoordinatesOfTheMap) {
  BallsOnThePlain scene;
  scene.put({1100, 1900, 130}, 20, {40, 30, 20});
  scene.put({1100, 1900, 170}, 4);
  std::vector<const Subject*> subjects = {scene.ground.get()};
  for (const auto& ball : scene.balls) subjects.push_back(ball.get());
  SceneSubject all(subjects);
  std::vector<bool> shown(3, true);
  all.isShown = [&](std::size_t i) { return bool(shown[i]); };
  const Camera camera = straightDown({1100, 1900, 0}, 300);
  auto pick = all.pick(camera, {100, 100}, {});
  ASSERT_TRUE(pick);
  EXPECT_EQ(pick->object, 2u);
  EXPECT_NEAR(pick->height, 174, 0.1);
  EXPECT_NEAR(pick->xy.x, 1100, 1e-6);
  EXPECT_NEAR(pick->metres, 126, 0.1);
  EXPECT_NEAR(norm(pick->inObject), 1, 0.02);
  shown[2] = false;
  pick = all.pick(camera, {100, 100}, {});
  ASSERT_TRUE(pick);
  EXPECT_EQ(pick->object, 1u);
  EXPECT_NEAR(pick->height, 150, 0.5);
  pick = all.pick(camera, {60, 100}, {});
  ASSERT_TRUE(pick);
  EXPECT_EQ(pick->object, 0u);
  EXPECT_NEAR(pick->xy.x, 1100 - 40 * 2, 1e-6);
}

TEST(SurfaceScene, ABudgetMakesOneToleranceForAllObjectsTimesTheirFactors) {
  ARETE_NEEDS_OPENGL(probe);
  BallsOnThePlain scene;
  scene.put({1100, 1900, 130}, 20);
  scene.put({1130, 1900, 130}, 10);
  ViewSettings settings = unshaded();
  settings.maxTriangles = 600;
  auto view = scene.view(settings);
  ASSERT_TRUE(view);
  view->scene().objects()[2].toleranceFactor = 3;
  const auto figures = view->draw(straightDown({1110, 1900, 0}, 220));
  ASSERT_TRUE(figures) << figures.error().describe();
  EXPECT_LE(figures->triangles, 600u);
  EXPECT_GT(figures->triangles, 300u);
  const auto& objects = view->scene().objects();
  EXPECT_NEAR(objects[1].figures.pixels, figures->pixels, 1e-9);
  EXPECT_NEAR(objects[2].figures.pixels, 3 * figures->pixels, 1e-9);
}

TEST(SurfaceScene, WithoutATerrainAndABudgetTheToleranceIsKept) {
  ARETE_NEEDS_OPENGL(probe);
  const BallsOnThePlain scene;
  auto view = HeadlessView::create(
      {.widthPixels = kSide, .heightPixels = kSide, .samples = 1, .settings = unshaded()},
      [&](Scene& shown) -> Status {
        ARETE_TRY(const auto assets, SurfaceAssets::create(scene.ball, scene.form->upright));
        for (const double x : {-2.0, 2.0}) {
          Placement there;
          there.anchor = {x, 0, 0};
          ARETE_CHECK(shown.add(std::make_unique<SurfaceDrawable>(
              assets, std::make_shared<SurfaceSubject>(scene.form, there, nullptr))));
        }
        return {};
      });
  ASSERT_TRUE(view);
  const auto figures = view->draw(straightDown({0, 0, 0}, 5));
  ASSERT_TRUE(figures);
  EXPECT_TRUE(figures->isComplete);
  EXPECT_EQ(figures->pixels, 1);
  EXPECT_GT(figures->triangles, 500u);
}

TEST(SurfaceScene, ALevelByHandStaysWhateverTheCamera) {
  ARETE_NEEDS_OPENGL(probe);
  BallsOnThePlain scene;
  scene.put({1100, 1900, 130}, 20);
  auto view = scene.view();
  ASSERT_TRUE(view);
  ShownObject& ball = view->scene().objects()[1];
  ball.level = HandLevel{.triangles = 100};
  ASSERT_TRUE(view->draw(straightDown({1110, 1900, 0}, 220)));
  EXPECT_LE(ball.figures.triangles, 100u);
  EXPECT_GE(ball.figures.triangles, 98u);
  ball.level = HandLevel{.error = 0};
  ASSERT_TRUE(view->draw(straightDown({1110, 1900, 0}, 5000)));
  EXPECT_EQ(ball.figures.triangles, scene.ball.mt.finestTriangleCount());
  ball.isShown = false;
  const auto without = view->draw(straightDown({1110, 1900, 0}, 220));
  ASSERT_TRUE(without);
  EXPECT_EQ(without->triangles, view->scene().objects()[0].figures.triangles);
}

TEST(SurfaceScene, ASurfaceWithoutAPlaceBesideAnotherModelIsRefusedByName) {
  ARETE_NEEDS_OPENGL(probe);
  BallsOnThePlain scene;
  auto view = scene.view();
  ASSERT_TRUE(view);
  auto alone =
      SurfaceDrawable::create(scene.ball, std::make_shared<SurfaceSubject>(scene.ball, ZUpFrame(scene.ball)));
  ASSERT_TRUE(alone);
  const Status added =
      view->scene().add(std::make_unique<SurfaceDrawable>(std::move(*alone)), {.name = "lost"});
  ASSERT_FALSE(added);
  EXPECT_EQ(added.error().culprit, "lost");
}

TEST(SurfaceScene, ATurnedSurfaceIsSeenFromItsOtherSideByTheSameHomeView) {
  const SurfaceModel ball = ballOf(1);
  const auto form = std::make_shared<const SurfaceForm>(ball, ZUpFrame(ball));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(-180, 180);
  for (int i = 0; i < 20; ++i) {
    const Turn turn{angle(random), angle(random), angle(random)};
    const SurfaceSubject turned(form, turn);
    const Camera camera =
        turned.home(HomeView::fromSouth, Camera{.widthPixels = 400, .heightPixels = 300}, {});
    const auto pick = turned.pick(camera, {200, 150}, {});
    ASSERT_TRUE(pick) << "seed 5, turn " << i;
    // The place of the file that looks south now.
    const Vec3 south = Similarity(turn, 1, {}).inverse().direction({0, -1, 0});
    EXPECT_GT(dot(unit(pick->inObject - form->upright.toFile({})), south), 0.99) << "seed 5, turn " << i;
    EXPECT_LT(norm(turned.inFile(pick->metric) - pick->inObject), 1e-9);
  }
}

}  // namespace
}  // namespace arete
