// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets/families.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace arete {
namespace {

std::size_t validSamples(const RasterHeightfield& field) {
  return static_cast<std::size_t>(
      std::count_if(field.heights.begin(), field.heights.end(), [](double z) { return !std::isnan(z); }));
}

int validCorners(const RasterHeightfield& field, std::uint32_t column, std::uint32_t row) {
  return field.isValid(column, row) + field.isValid(column + 1, row) + field.isValid(column, row + 1) +
         field.isValid(column + 1, row + 1);
}

/// Cells that give at least one triangle.
std::size_t cellsWithTriangles(const RasterHeightfield& field) {
  std::size_t cells = 0;
  for (std::uint32_t row = 0; row + 1 < field.rows; ++row)
    for (std::uint32_t column = 0; column + 1 < field.columns; ++column)
      cells += validCorners(field, column, row) >= 3;
  return cells;
}

const RasterFamily& familyNamed(std::string_view name) {
  const auto families = rasterFamilies();
  return *std::find_if(families.begin(), families.end(), [&](const auto& f) { return f.name == name; });
}

bool allCollinear(const PointHeightfield& field) {
  std::size_t second = 1;
  while (second < field.size() && field.positions[second] == field.positions[0]) ++second;
  if (second >= field.size()) return true;
  const Vec2 o = field.positions[0], d = {field.positions[second].x - o.x, field.positions[second].y - o.y};
  return std::all_of(field.positions.begin(), field.positions.end(),
                     [&](Vec2 p) { return d.x * (p.y - o.y) == d.y * (p.x - o.x); });
}

TEST(RasterFamilies, HaveTheShapeAskedForAndOneWholeCell) {
  for (const RasterFamily& family : rasterFamilies())
    for (const auto& [columns, rows] : {std::pair{2u, 2u}, {3u, 5u}, {17u, 9u}, {64u, 48u}})
      for (std::uint64_t seed = 0; seed < 8; ++seed) {
        SCOPED_TRACE(::testing::Message()
                     << family.name << " " << columns << "x" << rows << " seed " << seed);
        const RasterHeightfield field = family.make(columns, rows, seed);
        ASSERT_EQ(field.columns, columns);
        ASSERT_EQ(field.rows, rows);
        ASSERT_TRUE(field.validate());
        bool whole = false;
        for (std::uint32_t row = 0; row + 1 < rows; ++row)
          for (std::uint32_t column = 0; column + 1 < columns; ++column)
            whole = whole || validCorners(field, column, row) == 4;
        EXPECT_TRUE(whole);
      }
}

/// Name and checksum of each family at 40 x 30 samples, or 100 points, seed 7.
using Golden = std::map<std::string, std::string, std::less<>>;

const Golden kGoldenRasters = {
    {"flat", "xxh3-128:8641be126be08d9074ab5f805778f7a8"},
    {"ramp", "xxh3-128:5870a3e60907a786e4061f7f4cc94f3f"},
    {"noise", "xxh3-128:1ecadeec79bbfed9b9fc5f98b960ed16"},
    {"fractal", "xxh3-128:84809c2195fe7b359e3161be97485aa5"},
    {"cliffs", "xxh3-128:7c3d7b5791dae4bc76724a70cadaaaae"},
    {"pits and spikes", "xxh3-128:bade2f8bf1f14f36be1b020e996b67cb"},
    {"nodata holes", "xxh3-128:2d8551cd09877deab90acdee8f9b98b6"},
    {"islands", "xxh3-128:853d5653d138da63e7041f90f1394dda"},
    {"collinear ridges", "xxh3-128:faf233f928bb7e72f5f7735e46ec9b97"},
    {"integer", "xxh3-128:1c44193710ce1349777c629c359231a1"},
    {"huge offset", "xxh3-128:9e3f1360edb032dc34a4bdc8048115fa"},
    {"geographic", "xxh3-128:84809c2195fe7b359e3161be97485aa5"},
    {"rotated", "xxh3-128:84809c2195fe7b359e3161be97485aa5"},
    {"south up", "xxh3-128:84809c2195fe7b359e3161be97485aa5"},
};
const Golden kGoldenPoints = {
    {"random", "xxh3-128:66a97ccc669b0b0ad59d3a74aafd1103"},
    {"grid", "xxh3-128:6691f14b17bc5424a277bfe1917a23ad"},
    {"cocircular", "xxh3-128:dd98b2931790c59c47b3ccb348bae756"},
    {"clustered", "xxh3-128:ed8da74b3b8637cbacfab43aeddf23f3"},
    {"huge offset", "xxh3-128:a4e13b11cf0f90db2dfa423d15430cdc"},
    {"duplicates", "xxh3-128:da8808d4b70c44e6515c913a4cbc689f"},
};

TEST(RasterFamilies, MakeTheSameHeightsOnEveryMachine) {
  ASSERT_EQ(kGoldenRasters.size(), rasterFamilies().size());
  for (const RasterFamily& family : rasterFamilies())
    EXPECT_EQ(heightsChecksum(family.make(40, 30, 7)), kGoldenRasters.at(std::string(family.name)))
        << family.name;
}

TEST(PointFamilies, MakeTheSamePointsOnEveryMachine) {
  ASSERT_EQ(kGoldenPoints.size(), pointFamilies().size());
  for (const PointFamily& family : pointFamilies())
    EXPECT_EQ(heightsChecksum(family.make(100, 7)), kGoldenPoints.at(std::string(family.name)))
        << family.name;
}

TEST(RasterFamilies, DependOnTheSeed) {
  for (const RasterFamily& family : rasterFamilies())
    EXPECT_NE(heightsChecksum(family.make(20, 30, 7)), heightsChecksum(family.make(20, 30, 8)))
        << family.name;
}

TEST(RasterFamilies, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const auto families : {rasterFamilies(), degenerateFamilies()})
    for (const RasterFamily& family : families) EXPECT_TRUE(names.insert(family.name).second) << family.name;
}

TEST(RasterFamilies, PlantIsolatedSamplesAndPinchesAmongTheHoles) {
  std::size_t isolated = 0, pinches = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const RasterHeightfield field = familyNamed("nodata holes").make(64, 64, seed);
    EXPECT_LT(validSamples(field), field.size());
    for (std::uint32_t row = 1; row + 1 < field.rows; ++row)
      for (std::uint32_t column = 1; column + 1 < field.columns; ++column) {
        if (!field.isValid(column, row)) continue;
        const bool upperLeft = validCorners(field, column - 1, row - 1) >= 3;
        const bool upperRight = validCorners(field, column, row - 1) >= 3;
        const bool lowerLeft = validCorners(field, column - 1, row) >= 3;
        const bool lowerRight = validCorners(field, column, row) >= 3;
        isolated += !upperLeft && !upperRight && !lowerLeft && !lowerRight;
        pinches += upperLeft && lowerRight && !upperRight && !lowerLeft;
      }
  }
  EXPECT_GT(isolated, 0u);
  EXPECT_GT(pinches, 0u);
}

TEST(RasterFamilies, LeaveIslandsInMostlyNoData) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const RasterHeightfield field = familyNamed("islands").make(80, 80, seed);
    EXPECT_LT(validSamples(field), field.size() / 2);
  }
}

TEST(RasterFamilies, MakeARampThatIsAnExactPlane) {
  const RasterHeightfield field = familyNamed("ramp").make(40, 30, 3);
  const double dx = field.at(1, 0) - field.at(0, 0), dy = field.at(0, 1) - field.at(0, 0);
  for (std::uint32_t row = 0; row < field.rows; ++row)
    for (std::uint32_t column = 0; column < field.columns; ++column)
      ASSERT_EQ(field.at(column, row), field.at(0, 0) + dx * column + dy * row);
}

TEST(RasterFamilies, MakeIntegerHeightsWhereTheySaySo) {
  for (const double z : familyNamed("integer").make(40, 30, 3).heights) ASSERT_EQ(z, std::floor(z));
}

TEST(DegenerateFamilies, HaveNoCellThatGivesATriangle) {
  for (const RasterFamily& family : degenerateFamilies())
    for (const auto& [columns, rows] : {std::pair{1u, 1u}, {2u, 2u}, {13u, 8u}}) {
      const RasterHeightfield field = family.make(columns, rows, 5);
      ASSERT_TRUE(field.validate()) << family.name;
      EXPECT_EQ(cellsWithTriangles(field), 0u) << family.name;
    }
}

TEST(PointFamilies, HaveTheCountAskedForAndAnArea) {
  for (const PointFamily& family : pointFamilies())
    for (const std::uint32_t count : {4u, 5u, 100u, 1000u})
      for (std::uint64_t seed = 0; seed < 4; ++seed) {
        SCOPED_TRACE(::testing::Message() << family.name << " " << count << " points, seed " << seed);
        const PointHeightfield field = family.make(count, seed);
        ASSERT_EQ(field.size(), count);
        ASSERT_TRUE(field.validate());
        EXPECT_FALSE(allCollinear(field));
        EXPECT_EQ(heightsChecksum(field), heightsChecksum(family.make(count, seed)));
      }
}

TEST(PointFamilies, PutCocircularPointsOnOneCircle) {
  const auto families = pointFamilies();
  const auto family =
      std::find_if(families.begin(), families.end(), [](const auto& f) { return f.name == "cocircular"; });
  const PointHeightfield field = family->make(400, 1);
  const auto onCircle = std::count_if(field.positions.begin(), field.positions.end(),
                                      [](Vec2 p) { return p.x * p.x + p.y * p.y == 32045.0 * 32045.0; });
  EXPECT_EQ(onCircle, 324);
}

TEST(PointFamilies, RepeatPointsOnlyWithTheSameHeightUnlessTheySayOtherwise) {
  for (const auto families : {pointFamilies(), degeneratePointFamilies()})
    for (const PointFamily& family : families) {
      const PointHeightfield field = family.make(60, 2);
      bool contradicts = false;
      for (std::size_t a = 0; a < field.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
          contradicts = contradicts ||
                        (field.positions[a] == field.positions[b] && field.heights[a] != field.heights[b]);
      EXPECT_EQ(contradicts, family.name == "two heights at one place") << family.name;
    }
}

}  // namespace
}  // namespace arete
