// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a heightfield refuses, and which changes its checksum sees.
#include "terrain/model/heightfield.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "datasets/families.h"

namespace arete {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

RasterHeightfield raster() {
  RasterHeightfield field;
  field.columns = 3;
  field.rows = 2;
  field.heights = {1, 2, 3, 4, kNaN, 6};
  field.source = "a.tif";
  return field;
}

PointHeightfield points() {
  PointHeightfield field;
  field.positions = {{0, 0}, {1, 0}, {0, 1}};
  field.heights = {1, 2, 3};
  field.source = "a.xyz";
  return field;
}

TEST(RasterHeightfield, IndexesRowByRow) {
  const RasterHeightfield field = raster();
  EXPECT_EQ(field.index(2, 1), 5u);
  EXPECT_EQ(field.at(0, 1), 4);
  EXPECT_TRUE(field.isValid(0, 1));
  EXPECT_FALSE(field.isValid(1, 1));
}

TEST(RasterHeightfield, IsValidOnEveryFamilyAndRefusesWhatIsBroken) {
  for (const RasterFamily& family : rasterFamilies())
    EXPECT_TRUE(family.make(9, 7, 1).validate()) << family.name;
  for (const RasterFamily& family : degenerateFamilies())
    EXPECT_TRUE(family.make(9, 7, 1).validate()) << family.name;
  const auto refused = [](const RasterHeightfield& field) {
    const Status status = field.validate();
    EXPECT_FALSE(status);
    if (status) return std::string();
    EXPECT_EQ(status.error().code, ErrorCode::invalidData);
    EXPECT_EQ(status.error().culprit, "a.tif");
    return status.error().message;
  };
  RasterHeightfield field = raster();
  field.heights.pop_back();
  EXPECT_EQ(refused(field), "5 heights for 3 columns and 2 rows");
  field = raster();
  field.heights[5] = -kInfinity;
  EXPECT_EQ(refused(field), "the height at column 2, row 1 is infinite");
  field = raster();
  field.georeference.geoTransform = {0, 1, 2, 0, 2, 4};
  EXPECT_EQ(refused(field), "the geotransform is not invertible");
  field.georeference.geoTransform = {0, 1, 0, 0, 0, kNaN};
  EXPECT_EQ(refused(field), "the geotransform is not invertible");
}

TEST(PointHeightfield, IsValidOnEveryFamilyAndRefusesWhatIsBroken) {
  for (const PointFamily& family : pointFamilies()) EXPECT_TRUE(family.make(20, 1).validate()) << family.name;
  PointHeightfield field = points();
  field.heights.push_back(4);
  EXPECT_EQ(field.validate().error().describe(), "a.xyz: 4 heights for 3 positions");
  for (const double bad : {kNaN, kInfinity, -kInfinity})
    for (int where = 0; where < 3; ++where) {
      field = points();
      (where == 0 ? field.positions[1].x : where == 1 ? field.positions[1].y : field.heights[1]) = bad;
      ASSERT_FALSE(field.validate());
      EXPECT_EQ(field.validate().error().message, "point 1 has a coordinate that is not finite");
    }
}

TEST(HeightsChecksum, DependsOnTheSamplesAndTheShapeAlone) {
  const std::string sum = heightsChecksum(raster());
  EXPECT_EQ(sum.size(), std::string("xxh3-128:").size() + 32);
  RasterHeightfield same = raster();
  same.source = "b.asc";
  same.rawScale = 0.1;
  same.georeference.geoTransform[0] = 7;
  same.heights[4] = -kNaN;
  EXPECT_EQ(heightsChecksum(same), sum);
  RasterHeightfield zero = raster(), negativeZero = raster();
  zero.heights[0] = 0.0;
  negativeZero.heights[0] = -0.0;
  EXPECT_EQ(heightsChecksum(zero), heightsChecksum(negativeZero));

  std::set<std::string> sums = {sum, heightsChecksum(zero), heightsChecksum(points())};
  RasterHeightfield turned = raster();
  std::swap(turned.columns, turned.rows);
  EXPECT_TRUE(sums.insert(heightsChecksum(turned)).second);
  for (std::size_t i = 0; i < raster().size(); ++i) {
    RasterHeightfield other = raster();
    other.heights[i] = std::isnan(other.heights[i]) ? 5 : std::nextafter(other.heights[i], 9);
    EXPECT_TRUE(sums.insert(heightsChecksum(other)).second) << i;
  }
  PointHeightfield moved = points();
  moved.positions[2].y = std::nextafter(1.0, 2.0);
  EXPECT_TRUE(sums.insert(heightsChecksum(moved)).second);
  // More samples than one block of the hash.
  RasterHeightfield large = rasterFamilies()[0].make(90, 91, 1);
  const std::string before = heightsChecksum(large);
  large.heights.back() += 1;
  EXPECT_NE(heightsChecksum(large), before);
}

}  // namespace
}  // namespace arete
