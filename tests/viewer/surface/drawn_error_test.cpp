// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stored error of the drawn triangle that a pixel meets, against the engine's own cut of the same level,
// whose triangles are tried one by one; and the tint of what a box leaves out, by pixels.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "surface/builder/build.h"
#include "surface/families.h"
#include "viewer/drawn_mesh.h"
#include "viewer/headless/headless.h"
#include "viewer/objects/object_list.h"
#include "viewer/surface/surface_drawable.h"

namespace arete {
namespace {

constexpr int kErrorSide = 160;

Result<HeadlessView> pictured(const std::shared_ptr<SurfaceSubject>& subject, const ViewSettings& settings) {
  return HeadlessView::create(
      {.widthPixels = kErrorSide, .heightPixels = kErrorSide, .samples = 1, .settings = settings},
      [&](Scene& scene) -> Status {
        ARETE_TRY(SurfaceDrawable made, SurfaceDrawable::create(subject->model(), subject));
        return scene.add(std::make_unique<SurfaceDrawable>(std::move(made)));
      });
}

Camera wholeOf(const Subject& subject) {
  Camera picture;
  picture.widthPixels = picture.heightPixels = kErrorSide;
  return subject.home(HomeView::overview, picture, {});
}

TEST(DrawnError, IsThatOfTheTriangleOfTheCutThatThePixelMeets) {
  ARETE_NEEDS_OPENGL(probe);
  const SurfaceModel model = std::move(*buildSurface(SurfaceMesh(shapes::globe(48, 32))));
  for (const Turn& turn : {Turn{}, Turn{40, 20, 10}}) {
    const auto form = std::make_shared<const SurfaceForm>(model, ZUpFrame(model));
    const auto subject = std::make_shared<SurfaceSubject>(form, turn);
    ViewSettings settings;
    settings.look.coloring = Coloring::material;
    auto view = pictured(subject, settings);
    ASSERT_TRUE(view) << view.error().describe();
    ObjectList objects(view->scene());
    const Camera camera = wholeOf(*subject);
    for (const double error : {0.2, 0.02}) {
      objects.setLevel(HandLevel{.error = error});
      ASSERT_TRUE(view->draw(camera));
      const Cut cut = *takeCut(model.mt, UniformError(error));
      int met = 0;
      for (int y = 8; y < kErrorSide; y += 12)
        for (int x = 8; x < kErrorSide; x += 12) {
          const Vec2 pixel{x + 0.37, y + 0.41};
          const auto pick = subject->pick(camera, pixel, settings);
          const auto got = objects.drawnError(pick.value_or(Pick{}), camera, pixel, settings);
          const View seen = *subject->viewOf(camera, settings);
          const Similarity back = subject->pose(settings).inverse();
          const Vec3 from = back(seen.eye), way = back.direction(directionOfPixel(seen, false, pixel));
          double nearest = 1e300, wanted = -1;
          for (const std::uint32_t id : cut.ids) {
            std::array<Vec3, 3> t;
            for (std::size_t i = 0; i < 3; ++i)
              t[i] = subject->upright().turned(model.mt.metric().toMetric(
                  model.mt.position(VertexId(model.mt.corners(TriangleId(id))[i]))));
            const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
            const double along = dot(n, t[0] - from) / dot(n, way);
            const Vec3 hit = from + along * way;
            bool isInside = along > 0;
            for (std::size_t i = 0; i < 3; ++i)
              isInside = isInside && dot(n, cross(t[(i + 1) % 3] - t[i], hit - t[i])) >= 0;
            if (!isInside || along >= nearest) continue;
            nearest = along;
            wanted = model.mt.error(TriangleId(id));
          }
          ASSERT_EQ(got.has_value(), wanted >= 0) << x << " " << y;
          if (!got) continue;
          ++met;
          EXPECT_NEAR(*got, wanted, 1e-6 * wanted) << x << " " << y;
          EXPECT_LE(*got, error * (1 + 1e-6));
        }
      EXPECT_GT(met, 30);
    }
  }
}

TEST(DrawnError, IsAlsoOfTrianglesThatMove) {
  ARETE_NEEDS_OPENGL(probe);
  const SurfaceModel model = std::move(*buildSurface(SurfaceMesh(shapes::globe(96, 64))));
  const auto form = std::make_shared<const SurfaceForm>(model, ZUpFrame(model));
  const auto subject = std::make_shared<SurfaceSubject>(form, Turn{});
  ViewSettings settings;
  settings.pixels = 0.7;
  settings.look.coloring = Coloring::material;
  auto view = pictured(subject, settings);
  ASSERT_TRUE(view) << view.error().describe();
  const Camera camera = wholeOf(*subject);
  const auto figures = view->draw(camera);
  ASSERT_TRUE(figures);
  ASSERT_GT(figures->moving, 0u);
  ObjectList objects(view->scene());
  int met = 0;
  for (int y = 4; y < kErrorSide; y += 8)
    for (int x = 4; x < kErrorSide; x += 8)
      if (const auto pick = subject->pick(camera, {double(x), double(y)}, settings))
        met += objects.drawnError(*pick, camera, {double(x), double(y)}, settings).has_value() ? 1 : 0;
  EXPECT_GT(met, 80);
}

TEST(KeptBox, TintsWhatLiesOutsideAndNothingElse) {
  ARETE_NEEDS_OPENGL(probe);
  SurfaceMesh mesh(shapes::sheet(9, 9));
  for (Vec3& p : mesh.positions) p = p + Vec3{2'600'000, 1'200'000, 450};
  const SurfaceModel model = std::move(*buildSurface(std::move(mesh)));
  const auto form = std::make_shared<const SurfaceForm>(model, ZUpFrame(model));
  const auto subject = std::make_shared<SurfaceSubject>(form, Turn{});
  ViewSettings settings;
  settings.look.coloring = Coloring::plain;
  settings.look.isShaded = false;
  auto view = pictured(subject, settings);
  ASSERT_TRUE(view) << view.error().describe();
  Camera picture;
  picture.widthPixels = picture.heightPixels = kErrorSide;
  const Camera camera = subject->home(HomeView::fromAbove, picture, settings);
  ASSERT_TRUE(view->draw(camera));
  const Image plain = view->image();
  // The western half of 8 units is kept.
  const Vec3 low = subject->upright().fromFile({2'600'000 - 1, 1'200'000 - 1, 449}),
             high = subject->upright().fromFile({2'600'000 + 4, 1'200'000 + 9, 451});
  view->scene().objects()[0].kept = KeptBox{low, high};
  ASSERT_TRUE(view->draw(camera));
  const Image tinted = view->image();
  int outside = 0, inside = 0;
  for (int y = 0; y < kErrorSide; y += 5)
    for (int x = 0; x < kErrorSide; x += 5) {
      const auto pick = subject->pick(camera, {x + 0.5, y + 0.5}, settings);
      if (!pick || std::abs(pick->inObject.x - 2'600'004) < 0.1) continue;
      const Rgb before = plain.at(x, y), after = tinted.at(x, y);
      if (pick->inObject.x < 2'600'004) {
        ++inside;
        EXPECT_TRUE(before.r == after.r && before.g == after.g && before.b == after.b) << x << " " << y;
      } else {
        ++outside;
        EXPECT_GT(int(after.r) - int(after.g), 40) << x << " " << y;
      }
    }
  EXPECT_GT(inside, 50);
  EXPECT_GT(outside, 50);
}

}  // namespace
}  // namespace arete
