// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/surface/surface_session.h"

#include <gtest/gtest.h>

namespace arete {
namespace {

SurfaceSession session() {
  ZUpShape shape{.box = {{-1, -2, -3}, {1, 2, 3}}, .points = {}};
  for (const Vec3& corner : shape.box.corners()) shape.points.push_back(corner);
  Camera picture;
  picture.widthPixels = 400;
  picture.heightPixels = 300;
  return {shape, surfaceHome(HomeView::overview, shape, picture), {}};
}

double distanceToMiddle(const Camera& camera) {
  return norm(CameraSpace().position(camera));
}

TEST(SurfaceSession, DraggingTurnsAroundTheMiddle) {
  SurfaceSession s = session();
  const Camera before = s.camera();
  InputState input;
  input.leftButton = true;
  input.mouseMoved = {50, 20};
  s.step(input);
  EXPECT_NE(s.camera().azimuthDegrees, before.azimuthDegrees);
  EXPECT_NEAR(distanceToMiddle(s.camera()), distanceToMiddle(before), 0.1);  // it looks a little beside it
}

TEST(SurfaceSession, TheWheelComesNearerAndTheRightButtonMoves) {
  SurfaceSession s = session();
  const double before = distanceToMiddle(s.camera());
  InputState wheel;
  wheel.wheel = 2;
  s.step(wheel);
  EXPECT_LT(distanceToMiddle(s.camera()), 0.8 * before);
  const Look look = lookOf(s.camera());
  InputState drag;
  drag.rightButton = true;
  drag.mouseMoved = {30, 0};
  s.step(drag);
  EXPECT_EQ(lookOf(s.camera()).azimuthDegrees, look.azimuthDegrees);
  EXPECT_GT(distanceToMiddle(s.camera()), 0);
}

TEST(SurfaceSession, HomeViewsFollowEachOtherAndCloseTheRound) {
  SurfaceSession s = session();
  const Camera first = s.camera();
  for (std::size_t i = 0; i < kHomeViews.size(); ++i) s.apply(Action::nextHome);
  EXPECT_EQ(s.homeView, HomeView::overview);
  EXPECT_NEAR(s.camera().xy.x, first.xy.x, 1e-9);
  EXPECT_NEAR(s.camera().height, first.height, 1e-9);
}

TEST(SurfaceSession, ActionsOfTerrainDoNothing) {
  SurfaceSession s = session();
  const Camera before = s.camera();
  s.apply(Action::contours);
  s.apply(Action::playFlight);
  s.apply(Action::follow);
  EXPECT_EQ(s.camera().xy, before.xy);
  EXPECT_FALSE(s.settings.look.hasWireframe);
  s.apply(Action::wireframe);
  EXPECT_TRUE(s.settings.look.hasWireframe);
}

}  // namespace
}  // namespace arete
