// SPDX-License-Identifier: GPL-3.0-or-later
//
// Values of single cells, checked by lines: a target at the least height is seen, one a little lower is not.
#include "terrain/viewshed/exact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "datasets/families.h"
#include "datasets/random.h"

namespace arete::test {
namespace {

struct ScannedPlace {
  RasterHeightfield field;
  TerrainModel model;
  std::shared_ptr<const SightGrid> grid;
  std::unique_ptr<SightEarth> earth;
  std::unique_ptr<SightEngine> scan;

  explicit ScannedPlace(RasterHeightfield made) : field(std::move(made)), model() {
    model.columns = field.columns;
    model.rows = field.rows;
    model.georeference = field.georeference;
    grid = std::make_shared<SightGrid>(field.columns, field.rows, field.heights);
    earth = makePlaneEarth(model);
    scan = makeSightScan(grid);
  }
};

TEST(ViewshedExact, ATargetAtTheLeastHeightIsSeenAndALowerOneIsNot) {
  constexpr std::uint64_t kSeed = 131;
  Random random(kSeed);
  const ScannedPlace place(rasterFamilies()[3].make(40, 30, 2));
  int above = 0;
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", cell " << i);
    const Vec2 from{random.between(1, 38), random.between(1, 28)};
    const ViewshedObserver observer{from, place.grid->at(from) + random.between(0.5, 10)};
    const Vec2 to{double(random.below(40)), double(random.below(30))};
    const double ground = place.grid->at(to);
    ViewshedOptions options;
    options.value = ViewshedValue::leastHeight;
    const auto answer = ViewshedExact(*place.scan, *place.earth, 1, observer, options).at(to, ground);
    ASSERT_TRUE(answer);
    ASSERT_TRUE(std::isfinite(answer->value));
    EXPECT_EQ(answer->cell == ViewshedCell::seen, answer->value == 0);
    const auto cellWith = [&](double height) {
      ViewshedOptions raised;
      raised.targetHeight = height;
      return ViewshedExact(*place.scan, *place.earth, 1, observer, raised).at(to, ground)->cell;
    };
    const double margin = 1e-3 + 1e-5 * answer->value;
    EXPECT_EQ(cellWith(answer->value + margin), ViewshedCell::seen);
    if (answer->value > 2 * margin) {
      ++above;
      EXPECT_EQ(cellWith(answer->value - margin), ViewshedCell::hidden);
    }
  }
  EXPECT_GT(above, 50);
}

TEST(ViewshedExact, IsOutsideForNodataAndBeyondTheField) {
  const ScannedPlace place(rasterFamilies()[3].make(20, 20, 2));
  const ViewshedObserver observer{{5, 5}, 1000};
  ViewshedOptions options;
  options.field.greatestMetres = 3;
  const ViewshedExact exact(*place.scan, *place.earth, 1, observer, options);
  EXPECT_EQ(exact.at({6, 5}, std::nan(""))->cell, ViewshedCell::outside);
  EXPECT_EQ(exact.at({15, 5}, place.grid->at({15, 5}))->cell, ViewshedCell::outside);
}

TEST(ViewshedField, ContainsBothEndsOfItsRangesAndTurnsPastNorth) {
  const ViewshedField field{.leastMetres = 10, .greatestMetres = 20, .fromAzimuth = 350, .azimuthSpan = 30};
  EXPECT_TRUE(isInField(field, 10, 0));
  EXPECT_TRUE(isInField(field, 20, 0));
  EXPECT_FALSE(isInField(field, 9.999, 0));
  EXPECT_FALSE(isInField(field, 20.001, 0));
  EXPECT_TRUE(isInField(field, 15, 350));
  EXPECT_TRUE(isInField(field, 15, 20));
  EXPECT_TRUE(isInField(field, 15, -5));
  EXPECT_FALSE(isInField(field, 15, 21));
  EXPECT_FALSE(isInField(field, 15, 349));
  EXPECT_TRUE(isInField({}, 1e9, 123));
}

}  // namespace
}  // namespace arete::test
