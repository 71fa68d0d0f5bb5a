// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/builder/checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace arete {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(BuildChecks, RejectAnExtentBeyondTheRangeOfSpheres) {
  EXPECT_TRUE(checkSpan({1e29, 0, 5}, "dem"));
  for (const Vec3 span : {Vec3{1e30, 1, 1}, {1, 1e31, 1}, {1, 1, INFINITY}, {kNaN, 1, 1}}) {
    const Status status = checkSpan(span, "dem");
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::invalidData);
    EXPECT_EQ(status.error().culprit, "dem");
  }
}

TEST(BuildChecks, SayWhyARasterHasNoTriangle) {
  RasterHeightfield field;
  field.columns = 3;
  field.rows = 1;
  field.heights = {1, 2, 3};
  EXPECT_NE(whyNoTriangle(field).find("enclose no area"), std::string::npos);
  field.heights = {kNaN, kNaN, kNaN};
  EXPECT_NE(whyNoTriangle(field).find("no valid sample"), std::string::npos);
  field.columns = field.rows = 2;
  field.heights = {1, kNaN, kNaN, 4};
  EXPECT_NE(whyNoTriangle(field).find("2 valid samples"), std::string::npos);
}

TEST(BuildChecks, BoundTheRoundingOfInterpolatedHeights) {
  // Averages in single steps of doubles against long double.
  for (const double high : {1.0, 8848.0, 1e6, 1e-3})
    for (int i = 1; i < 200; ++i) {
      const double low = -high / 3, w = i / 200.0;
      const double computed = low + w * (high - low);
      const long double exact = static_cast<long double>(low) +
                                static_cast<long double>(w) * (static_cast<long double>(high) - low);
      EXPECT_LE(std::abs(static_cast<double>(computed - exact)), roundingSlack(low, high));
    }
  EXPECT_GE(crossingSlack(0, 10, 5000, 20), roundingSlack(0, 10));
  EXPECT_GT(crossingSlack(0, 10, 50'000, 20), crossingSlack(0, 10, 5000, 20))
      << "fewer digits far to the right";
}

}  // namespace
}  // namespace arete
