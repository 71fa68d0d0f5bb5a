// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/model/build_options.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace arete {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

std::string culpritOf(const BuildOptions& options) {
  const Status status = checkOptions(options, 100);
  if (status) return "accepted";
  EXPECT_EQ(status.error().code, ErrorCode::usage);
  EXPECT_FALSE(status.error().message.empty());
  return status.error().culprit;
}

TEST(BuildOptions, MayBeTheEndsOfEachRange) {
  EXPECT_EQ(culpritOf({}), "accepted");
  EXPECT_EQ(culpritOf({.shape = HoleShape::dataDependent}), "accepted");
  EXPECT_EQ(culpritOf({.maxDegree = 6}), "accepted");
  EXPECT_EQ(culpritOf({.maxDegree = 32}), "accepted");
  EXPECT_EQ(culpritOf({.thresholdRatio = 1e6}), "accepted");
  EXPECT_EQ(culpritOf({.minimumAspect = 0}), "accepted");
  EXPECT_EQ(culpritOf({.rimTolerance = 0}), "accepted");
  EXPECT_EQ(culpritOf({.fixedVertices = {0, 99}}), "accepted");
}

TEST(BuildOptions, AreRefusedWithTheFieldThatIsOutOfRange) {
  EXPECT_EQ(culpritOf({.maxDegree = 5}), "maxDegree");
  EXPECT_EQ(culpritOf({.maxDegree = 33}), "maxDegree");
  for (const double ratio : {1.0, 0.0, -2.0, 2e6, kNoNumber})
    EXPECT_EQ(culpritOf({.thresholdRatio = ratio}), "thresholdRatio") << ratio;
  for (const double aspect : {-1e-9, 0.5, kNoNumber})
    EXPECT_EQ(culpritOf({.minimumAspect = aspect}), "minimumAspect") << aspect;
  for (const double tolerance : {-0.5, double(INFINITY), kNoNumber})
    EXPECT_EQ(culpritOf({.rimTolerance = tolerance}), "rimTolerance") << tolerance;
  EXPECT_EQ(culpritOf({.fixedVertices = {3, 100}}), "fixedVertices");
}

}  // namespace
}  // namespace arete
