// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/packed/nodes/spread.h"

#include <gtest/gtest.h>

#include <limits>

namespace arete::packed {
namespace {

TEST(Spread, StatesAFactorThatIsAtLeastTheGrowthAndAnEighthOfAnOctaveMoreAtMost) {
  for (double growth = 1; growth < 1e9; growth *= 1.037) {
    const double factor = static_cast<double>(spreadFactor(spreadCode(growth)));
    EXPECT_GE(factor, growth * 1.02 * (1 - 1e-6));
    EXPECT_LE(factor, growth * 1.02 * 1.0906);
  }
  EXPECT_EQ(spreadCode(std::numeric_limits<double>::infinity()), kMostSpread);
  EXPECT_EQ(spreadFactor(kMostSpread), std::numeric_limits<float>::infinity());
  EXPECT_GE(spreadFactor(spreadCode(0.5)), 1.0f);
}

}  // namespace
}  // namespace arete::packed
