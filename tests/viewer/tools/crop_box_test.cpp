// SPDX-License-Identifier: GPL-3.0-or-later
//
// The handles of a box, by the pixels that they are dragged to: of surfaces far from the origin, y-up, turned
// and in a scene.
#include "viewer/tools/crop_box.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "surface/builder/build.h"
#include "surface/families.h"
#include "viewer/window/viewer_session.h"

namespace arete {
namespace {

/// A globe with a middle of its own.
SurfaceModel globeAt(const Vec3& middle) {
  SurfaceMesh mesh(shapes::globe(24, 16));
  for (Vec3& p : mesh.positions) p = p + middle;
  return std::move(*buildSurface(std::move(mesh)));
}

std::array<double, 6> boundsOf(const CropBox& box) {
  std::array<double, 6> bounds{};
  for (std::size_t face = 0; face < 6; ++face) bounds[face] = box.bound(face);
  return bounds;
}

TEST(CropBox, StandsAroundTheSurfaceInTheFilesNumbers) {
  for (const bool isYUp : {false, true}) {
    const Vec3 middle{2'600'000.25, 1'200'000.5, 450};
    const SurfaceModel model = globeAt(middle);
    const SurfaceSubject subject(model, ZUpFrame(model, isYUp ? "y" : "z"));
    const CropBox box(subject);
    const std::array<double, 6> wanted = {middle.x - 1, middle.y - 1, middle.z - 1,
                                          middle.x + 1, middle.y + 1, middle.z + 1};
    const auto bounds = boundsOf(box);
    for (std::size_t face = 0; face < 6; ++face) EXPECT_NEAR(bounds[face], wanted[face], 0.05) << face;
    EXPECT_EQ(box.edges().vertices.size(), 24u);
  }
}

TEST(CropBox, AFaceFollowsTheMouseAlongItsAxisAlone) {
  for (const bool isYUp : {false, true}) {
    for (const Turn& turn : {Turn{}, Turn{30, 20, 0}}) {
      SCOPED_TRACE(testing::Message() << isYUp << " " << turn.heading);
      const SurfaceModel model = globeAt({2'600'000, 1'200'000, 450});
      const SurfaceSubject subject(
          std::make_shared<const SurfaceForm>(model, ZUpFrame(model, isYUp ? "y" : "z")), turn);
      const Camera camera = subject.home(HomeView::overview, {.widthPixels = 800, .heightPixels = 600});
      for (std::size_t face = 0; face < 6; ++face) {
        CropBox box(subject);
        const auto before = boundsOf(box);
        // Where the handle would be in the middle of its way to the other face.
        CropBox goal(subject);
        const double half = (before[face] + before[(face + 3) % 6]) / 2;
        goal.setBound(face, (before[face] + half) / 2);
        const auto from = pixelOf(subject, camera, box.handle(face)),
                   to = pixelOf(subject, camera, goal.handle(face));
        ASSERT_TRUE(from && to);
        if (std::hypot(to->x - from->x, to->y - from->y) < 10) continue;
        box.grab(camera, *from, {}, 14);
        ASSERT_EQ(box.held(), face);
        box.drag(camera, *to, {});
        const auto after = boundsOf(box);
        for (std::size_t other = 0; other < 6; ++other)
          EXPECT_NEAR(after[other], other == face ? goal.bound(face) : before[other], 1e-3) << other;
        box.release();
        box.drag(camera, *from, {});
        EXPECT_EQ(boundsOf(box), after) << "a face that is let go stays";
      }
    }
  }
}

TEST(CropBox, AFaceStaysBeforeTheOtherAndNothingIsTakenFarFromAHandle) {
  const SurfaceModel model = globeAt({});
  const SurfaceSubject subject(model, ZUpFrame(model));
  CropBox box(subject);
  box.setBound(0, 50);
  EXPECT_LT(box.bound(0), box.bound(3));
  box.setBound(3, -50);
  EXPECT_LT(box.bound(0), box.bound(3));
  box.setBound(1, std::nan(""));
  EXPECT_EQ(box.bound(1), box.whole().low.y);
  const Camera camera = subject.home(HomeView::overview, {.widthPixels = 800, .heightPixels = 600});
  box.grab(camera, {1, 1}, {}, 14);
  EXPECT_FALSE(box.held());
}

}  // namespace
}  // namespace arete
