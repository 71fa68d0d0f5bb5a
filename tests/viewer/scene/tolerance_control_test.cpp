// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/scene/tolerance_control.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace arete {
namespace {

/// A terrain whose triangles fall as the tolerance grows, and frames that take their time.
struct Model {
  double trianglesAtOne = 400000, millisecondsPerTriangle = 1e-4;
  std::uint32_t triangles(double pixels) const { return std::uint32_t(trianglesAtOne / pixels); }
  double milliseconds(double pixels) const { return 1 + millisecondsPerTriangle * triangles(pixels); }
};

double settled(const Model& model, const ToleranceControl::Wanted& wanted, int frames = 400) {
  ToleranceControl control;
  double pixels = wanted.pixels;
  for (int i = 0; i < frames; ++i)
    pixels = control.next(wanted, {model.milliseconds(pixels), model.triangles(pixels), pixels});
  return pixels;
}

TEST(ToleranceControl, WhereThereIsTimeAndRoomTheToleranceIsTheOneWanted) {
  EXPECT_DOUBLE_EQ(settled({}, {.pixels = 1.5}), 1.5);
  EXPECT_DOUBLE_EQ(
      settled({.trianglesAtOne = 1000}, {.pixels = 1, .maxTriangles = 2000, .frameMilliseconds = 16}), 1);
}

TEST(ToleranceControl, AFrameTimeIsKeptWithoutWastingIt) {
  const Model model;  // 41 ms at a pixel
  const double pixels = settled(model, {.pixels = 1, .frameMilliseconds = 16});
  EXPECT_LE(model.milliseconds(pixels), 16 * 1.02);
  EXPECT_GE(model.milliseconds(pixels), 16 * 0.8);
}

TEST(ToleranceControl, ABudgetIsReachedInAFewFrames) {
  const Model model;
  const ToleranceControl::Wanted wanted{.pixels = 1, .maxTriangles = 50000};
  const double pixels = settled(model, wanted, 3);
  EXPECT_LE(model.triangles(pixels), 50000u);
  EXPECT_GE(model.triangles(settled(model, wanted)), 45000u);
}

TEST(ToleranceControl, ItComesBackWhenTheSceneGetsEasier) {
  ToleranceControl control;
  const ToleranceControl::Wanted wanted{.pixels = 1, .frameMilliseconds = 16};
  double pixels = 1;
  for (int i = 0; i < 200; ++i) pixels = control.next(wanted, {40, 100000, pixels});
  EXPECT_GT(pixels, 10);
  for (int i = 0; i < 600; ++i) pixels = control.next(wanted, {4, 10000, pixels});
  EXPECT_DOUBLE_EQ(pixels, 1);
}

TEST(ToleranceControl, ItEndsAtTheCoarsest) {
  ToleranceControl control;
  double pixels = 1;
  for (int i = 0; i < 1000; ++i)
    pixels = control.next({.pixels = 1, .frameMilliseconds = 1, .coarsestPixels = 32}, {100, 100, pixels});
  EXPECT_DOUBLE_EQ(pixels, 32);
}

}  // namespace
}  // namespace arete
