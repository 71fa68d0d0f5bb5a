// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/packed/surface/coordinates.h"

#include <gtest/gtest.h>

#include <limits>

#include "datasets/random.h"

namespace arete::packed {
namespace {

MtKind kindOf(bool hasDoubles, double step) {
  MtKind kind;
  kind.model = ModelKind::surface;
  kind.hasDoubles = hasDoubles;
  kind.step = step;
  return kind;
}

TEST(Coordinates, ComeBackFromTheirWholeNumberToTheBit) {
  Random random(4);
  const Coordinates floats(kindOf(false, 0)), doubles(kindOf(true, 0)), quarters(kindOf(false, 0.25));
  for (int i = 0; i < 1000; ++i) {
    const double x = std::ldexp(2 * random.unit() - 1, static_cast<int>(random.below(80)) - 40);
    const auto single = static_cast<double>(static_cast<float>(x));
    EXPECT_EQ(floats.coordinate(floats.whole(single)), single);
    EXPECT_EQ(doubles.coordinate(doubles.whole(x)), x);
    const double multiple = static_cast<double>(random.below(1 << 23)) / 4;
    EXPECT_EQ(quarters.coordinate(quarters.whole(-multiple)), -multiple);
  }
  EXPECT_TRUE(std::signbit(floats.coordinate(floats.whole(-0.0))));
}

TEST(Coordinates, OfNeighboursAreNeighbours) {
  const Coordinates floats(kindOf(false, 0)), halves(kindOf(true, 0.5));
  EXPECT_EQ(floats.whole(static_cast<double>(std::nextafter(3.0f, 4.0f))) - floats.whole(3), 1);
  EXPECT_EQ(halves.whole(7.5) - halves.whole(7), 1);
}

TEST(Coordinates, ArePredictedByAnyNumber) {
  const Coordinates halves(kindOf(false, 0.5));
  EXPECT_EQ(halves.nearest(1.2), 2);
  EXPECT_EQ(halves.nearest(-1.3), -3);
  EXPECT_EQ(halves.nearest(std::numeric_limits<double>::quiet_NaN()), 0);
  EXPECT_EQ(halves.nearest(1e300), std::int64_t{1} << 53);
}

TEST(Coordinates, HaveAClassByHowManyLieWithinADistance) {
  const Coordinates floats(kindOf(false, 0)), halves(kindOf(false, 0.5));
  EXPECT_EQ(halves.classOf(0, 5, 36), 0u);
  EXPECT_EQ(halves.classOf(4, 5, 36), 4u);  // 8 steps
  EXPECT_EQ(halves.classOf(1e300, 5, 36), 35u);
  EXPECT_EQ(halves.classOf(1e-300, 5, 36), 0u);
  EXPECT_EQ(floats.classOf(0x1p-10, 1, 36), 14u);  // 2^13 floats
  // Near 0 floats are finer than any distance: those of the distance count.
  EXPECT_EQ(floats.classOf(0x1p-10, 1e-30, 36), 24u);
}

}  // namespace
}  // namespace arete::packed
