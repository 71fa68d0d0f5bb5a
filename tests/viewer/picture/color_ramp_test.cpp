// SPDX-License-Identifier: GPL-3.0-or-later
// Colours between those of a ramp.
#include "viewer/picture/color_ramp.h"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>

#include "viewer/picture_fixture.h"

namespace arete {
namespace {

using test::kNone;

TEST(ColorRamp, EndsAndMiddleAreWhatTheySay) {
  const auto ramp = divergingRamp();
  EXPECT_EQ(rampColor(ramp, -3), ramp.front());
  EXPECT_EQ(rampColor(ramp, 7), ramp.back());
  EXPECT_EQ(rampColor(ramp, 0.5), ramp[ramp.size() / 2]);
  EXPECT_EQ(rampColor(ramp, kNone), ramp.front());
}

TEST(ColorRamp, ClampsAndTakesTheFirstColourForNaN) {
  for (const auto ramp : {divergingRamp(), hypsometricRamp()}) {
    EXPECT_EQ(rampColor(ramp, -3), ramp.front());
    EXPECT_EQ(rampColor(ramp, 7), ramp.back());
    EXPECT_EQ(rampColor(ramp, std::numeric_limits<double>::quiet_NaN()), ramp.front());
    for (std::size_t i = 0; i < ramp.size(); ++i)
      EXPECT_EQ(rampColor(ramp, double(i) / double(ramp.size() - 1)), ramp[i]) << i;
  }
}

}  // namespace
}  // namespace arete
