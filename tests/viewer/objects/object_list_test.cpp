// SPDX-License-Identifier: GPL-3.0-or-later
//
// The objects of a scene under the user's hand, by the pictures' figures; and distances between places.
#include "viewer/objects/object_list.h"

#include <gtest/gtest.h>

#include "surface/builder/build.h"
#include "surface/families.h"
#include "terrain/builder/build.h"
#include "viewer/drawn_mesh.h"
#include "viewer/gl/terrain_drawable.h"
#include "viewer/headless/headless.h"
#include "viewer/objects/distance_picks.h"
#include "viewer/surface/surface_drawable.h"
#include "viewer/window/viewer_session.h"

namespace arete {
namespace {

/// Two balls on a plain.
class Objects : public testing::Test {
 protected:
  Objects() {
    RasterHeightfield field;
    field.columns = field.rows = 11;
    field.heights.assign(121, 0);
    field.georeference.geoTransform = {0, 10, 0, 100, 0, -10};
    field.georeference.hasGeoTransform = true;
    terrain_ = std::move(*build(field));
    ground_ = std::make_shared<const TerrainSubject>(terrain_);
    form_ = std::make_shared<const SurfaceForm>(ball_, ZUpFrame(ball_));
  }
  Result<HeadlessView> view() {
    return HeadlessView::create(
        {.widthPixels = 100, .heightPixels = 100, .samples = 1, .settings = {}}, [&](Scene& scene) -> Status {
          ARETE_TRY(TerrainDrawable made, TerrainDrawable::create(ground_, {}));
          ARETE_CHECK(scene.add(std::make_unique<TerrainDrawable>(std::move(made)), {.name = "plain"}));
          ARETE_TRY(const auto assets, SurfaceAssets::create(ball_, form_->upright));
          for (const char* name : {"west", "east"}) {
            Placement at;
            at.anchor = ground_->space().position({*name == 'w' ? 30.0 : 70.0, 50}, 20);
            at.scale = 8;
            ARETE_CHECK(scene.add(std::make_unique<SurfaceDrawable>(
                                      assets, std::make_shared<SurfaceSubject>(form_, at, ground_.get())),
                                  {.name = name}));
          }
          return {};
        });
  }
  Camera above() const {
    return {.xy = {50, 50}, .height = 120, .pitchDegrees = -90, .widthPixels = 100, .heightPixels = 100};
  }

  SurfaceModel ball_ = std::move(*buildSurface(SurfaceMesh(shapes::globe(48, 32))));
  TerrainModel terrain_;
  std::shared_ptr<const TerrainSubject> ground_;
  std::shared_ptr<const SurfaceForm> form_;
};

TEST_F(Objects, AreChosenRefinedCoarsenedAndShownAlone) {
  ARETE_NEEDS_OPENGL(probe);
  auto view = this->view();
  ASSERT_TRUE(view) << view.error().describe();
  ObjectList objects(view->scene());
  ASSERT_TRUE(view->draw(above()));
  EXPECT_EQ(objects.count(), 3u);
  EXPECT_EQ(objects.refine(), "plain: at most 4 triangles") << "the terrain is selected at first";
  EXPECT_EQ(objects.selectNext(), "west");
  const std::uint32_t before = objects.object().figures.triangles;
  objects.refine();
  ASSERT_TRUE(view->draw(above()));
  EXPECT_LE(objects.object().figures.triangles, 2 * before);
  EXPECT_GT(objects.object().figures.triangles, 3 * before / 2);
  EXPECT_FALSE(objects.object(2).level);
  objects.coarsen();
  objects.coarsen();
  ASSERT_TRUE(view->draw(above()));
  EXPECT_LT(objects.object().figures.triangles, before);
  objects.setLevel(std::nullopt);
  ASSERT_TRUE(view->draw(above()));
  EXPECT_EQ(objects.object().figures.triangles, before);

  view->scene().objects()[0].isShown = false;
  EXPECT_EQ(objects.toggleAlone(), "west alone");
  ASSERT_TRUE(view->draw(above()));
  EXPECT_FALSE(objects.object(2).isShown);
  EXPECT_EQ(objects.select(2), "east");
  EXPECT_TRUE(objects.object(2).isShown);
  EXPECT_FALSE(objects.object(1).isShown);
  objects.toggleAlone();
  EXPECT_FALSE(objects.object(0).isShown) << "as it was before";
  EXPECT_TRUE(objects.object(1).isShown);
}

TEST_F(Objects, AClickSelectsWhatItMeets) {
  ARETE_NEEDS_OPENGL(probe);
  auto view = this->view();
  ASSERT_TRUE(view);
  Scene& scene = view->scene();
  ViewerSession session(scene.subject(), scene.layers, {.camera = above()});
  session.objects.emplace(scene);
  session.click({30, 50});
  EXPECT_EQ(session.objects->nameOf(session.objects->selected()), "west");
  session.apply(Action::nextObject);
  EXPECT_EQ(session.message(), "east");
  session.apply(Action::refine);
  EXPECT_TRUE(scene.objects()[2].level);
  session.apply(Action::byView);
  EXPECT_FALSE(scene.objects()[2].level);
}

TEST_F(Objects, ATurnMovesWhatIsPicked) {
  ARETE_NEEDS_OPENGL(probe);
  auto view = this->view();
  ASSERT_TRUE(view);
  ObjectList objects(view->scene());
  EXPECT_FALSE(objects.turn()) << "a terrain";
  objects.select(1);
  ASSERT_TRUE(objects.turn());
  const auto before = view->scene().subject().pick(above(), {30, 50}, {});
  objects.setTurn({.heading = 180});
  const auto after = view->scene().subject().pick(above(), {30, 50}, {});
  ASSERT_TRUE(before && after);
  EXPECT_NEAR(before->inObject.x, -after->inObject.x, 0.05);
}

TEST(DistancePicks, AreThoseOfTheFileWithinAnObjectAndOfTheSceneBetweenTwo) {
  Layers layers;
  DistancePicks distance(layers);
  const auto at = [](const Vec3& metric, const Vec3& inObject, std::size_t object) {
    Pick pick;
    pick.metric = metric;
    pick.inObject = inObject;
    pick.object = object;
    return pick;
  };
  distance.add(at({0, 0, 0}, {1, 1, 1}, 1));
  EXPECT_EQ(layers.find(DistancePicks::kLayer), nullptr);
  distance.add(at({30, 40, 0}, {4, 5, 1}, 1));
  EXPECT_EQ(distance.way(), (Vec3{3, 4, 0}));
  EXPECT_EQ(distance.text("m"), "A 1,1,1\nB 4,5,1\ndistance 5 m, dx 3, dy 4, dz 0\n");
  EXPECT_NE(layers.find(DistancePicks::kLayer), nullptr);
  distance.add(at({0, 0, 0}, {1, 1, 1}, 1));
  EXPECT_EQ(distance.picks().size(), 1u);
  EXPECT_EQ(layers.find(DistancePicks::kLayer), nullptr);
  distance.add(at({30, 40, 0}, {4, 5, 1}, 2));
  EXPECT_EQ(distance.way(), (Vec3{30, 40, 0}));
  distance.clear();
  EXPECT_TRUE(distance.picks().empty());
}

}  // namespace
}  // namespace arete
