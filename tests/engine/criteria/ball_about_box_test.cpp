// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/criteria/ball_about_box.h"

#include <gtest/gtest.h>

#include <random>

namespace arete {
namespace {

TEST(BallAboutBox, HoldsEveryCornerAlsoFarFromTheOrigin) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> between(-1, 1);
  for (const double far : {0.0, 1.0, 1e6}) {
    for (int i = 0; i < 200; ++i) {
      MetricFrame metric;
      metric.origin = {far * between(random), 0, 3};
      metric.scale = {1 + between(random) / 2, 2, 0.5};
      Box3 box;
      box.low = {far + between(random), between(random), between(random)};
      box.high = box.low + Vec3{1 + between(random), 1 + between(random), 1 + between(random)};
      const Sphere ball = ballAboutBox(box, metric);
      for (int c = 0; c < 8; ++c) {
        const Vec3 corner{(c & 1) ? box.low.x : box.high.x, (c & 2) ? box.low.y : box.high.y,
                          (c & 4) ? box.low.z : box.high.z};
        EXPECT_LE(norm(metric.toMetric(corner) - Vec3{ball.x, ball.y, ball.z}), ball.radius);
      }
    }
  }
}

}  // namespace
}  // namespace arete
