// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/fronts/z_up_frame.h"

#include <gtest/gtest.h>

#include "surface/builder/build.h"
#include "surface/families.h"
#include "viewer/surface/surface_subject.h"

namespace arete {
namespace {

SurfaceModel tall(const std::string& up) {
  TriangleMesh mesh = shapes::globe(16, 9);
  for (Vec3& p : mesh.positions) p = {100 + p.x, 50 + 4 * p.y, p.z - 7};
  Result<SurfaceModel> model = buildSurface(SurfaceMesh(mesh));
  EXPECT_TRUE(model);
  model->up = up;
  return std::move(*model);
}

TEST(ZUpFrame, TurnsWhatPointsUpInTheFileToTheZAxis) {
  const SurfaceModel y = tall("y"), z = tall("z");
  const MetricBox ofY = uprightShape(y, ZUpFrame(y)).box, ofZ = uprightShape(z, ZUpFrame(z)).box;
  EXPECT_NEAR(ofY.high.z - ofY.low.z, 8, 0.3);
  EXPECT_NEAR(ofZ.high.z - ofZ.low.z, 2, 0.01);
  const SurfaceModel unsaid = tall("");
  EXPECT_NEAR(uprightShape(unsaid, ZUpFrame(unsaid, "y")).box.high.z, ofY.high.z, 1e-9);
  EXPECT_NEAR(uprightShape(unsaid, ZUpFrame(unsaid)).box.high.z, ofZ.high.z, 1e-9);
}

TEST(ZUpFrame, GoesToTheFileAndBackAndKeepsRightHandsRight) {
  for (const std::string up : {"y", "z"}) {
    const SurfaceModel model = tall(up);
    const ZUpFrame upright(model);
    for (const Vec3& p : {Vec3{100, 50, -7}, Vec3{101, 53, -6}, Vec3{99, 47, -8}}) {
      const Vec3 back = upright.toFile(upright.fromFile(p));
      EXPECT_NEAR(norm(back - p), 0, 1e-12);
    }
    const Vec3 x = upright.turned({1, 0, 0}), y = upright.turned({0, 1, 0}), z = upright.turned({0, 0, 1});
    EXPECT_EQ(cross(x, y), z);
  }
}

TEST(ZUpFrame, HomeViewsHaveTheWholeSurfaceInThePicture) {
  const SurfaceModel model = tall("y");
  const ZUpFrame upright(model);
  const SurfaceSubject subject(model, upright);
  for (const HomeView view : kHomeViews) {
    Camera picture;
    picture.widthPixels = 400;
    picture.heightPixels = 300;
    const Result<View> seen = subject.viewOf(subject.home(view, picture));
    ASSERT_TRUE(seen) << seen.error().describe();
    const Frustum frustum(*seen);
    for (std::uint32_t v = 0; v < model.mt.vertexCount(); ++v) {
      const Vec3 p = upright.fromFile(model.mt.position(VertexId(v)));
      EXPECT_TRUE(frustum.mayMeet(frustum.toView(p), 0)) << toString(view);
    }
  }
}

}  // namespace
}  // namespace arete
