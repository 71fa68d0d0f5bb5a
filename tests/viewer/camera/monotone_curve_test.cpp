// SPDX-License-Identifier: GPL-3.0-or-later
// Cubic curves that never overshoot.
#include "viewer/camera/monotone_curve.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "viewer/camera_models.h"

namespace arete {
namespace {

TEST(MonotoneCurve, MeetsItsKnotsStaysBetweenThemAndHasNoCorner) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    std::vector<double> knots = {0}, values = {random.between(-5, 5)};
    for (int i = 0; i < 8; ++i) {
      knots.push_back(knots.back() + random.between(0.1, 2));
      values.push_back(random.below(4) == 0 ? values.back() : random.between(-5, 5));
    }
    const MonotoneCurve curve(knots, values);
    for (std::size_t i = 0; i < knots.size(); ++i) {
      EXPECT_NEAR(curve.at(knots[i]), values[i], 1e-12) << "seed " << seed;
      if (i == 0 || i + 1 == knots.size()) continue;
      const double h = 1e-6;
      const double left = (curve.at(knots[i]) - curve.at(knots[i] - h)) / h;
      const double right = (curve.at(knots[i] + h) - curve.at(knots[i])) / h;
      EXPECT_NEAR(left, right, 2e-3) << "seed " << seed << ", knot " << i;
      double last = values[i];
      for (int k = 1; k <= 50; ++k) {
        const double value = curve.at(knots[i] + (knots[i + 1] - knots[i]) * k / 50);
        EXPECT_GE((value - last) * (values[i + 1] - values[i]), -1e-12) << "seed " << seed;
        last = value;
      }
    }
  }
}

TEST(MonotoneCurve, IsConstantBeyondItsEndsAndLinearBetweenTwoKnots) {
  const MonotoneCurve curve({1, 3}, {10, 20});
  EXPECT_EQ(curve.at(-5), 10);
  EXPECT_EQ(curve.at(9), 20);
  for (const double t : {1.0, 1.5, 2.0, 2.9, 3.0}) EXPECT_NEAR(curve.at(t), 10 + 5 * (t - 1), 1e-12) << t;
}

TEST(MonotoneCurve, IsFlatAtATurn) {
  const std::vector<double> knots = {0, 1, 2, 3}, values = {0, 5, 5, 1};
  const std::vector<double> slopes = monotoneSlopes(knots, values);
  ASSERT_EQ(slopes.size(), 4u);
  EXPECT_EQ(slopes[1], 0);
  EXPECT_EQ(slopes[2], 0);
}

}  // namespace
}  // namespace arete
