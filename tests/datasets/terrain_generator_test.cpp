// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets/terrain_generator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <vector>

namespace arete {
namespace {

RasterHeightfield generate(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed, bool lake = true,
                           bool sea = true, int threads = 0) {
  RunContext context;
  context.threads = threads;
  TerrainOptions options;
  options.columns = columns;
  options.rows = rows;
  options.seed = seed;
  options.lake = lake;
  options.sea = sea;
  Result<RasterHeightfield> field = generateTerrain(options, context);
  EXPECT_TRUE(field) << field.error().describe();
  return field ? *field : RasterHeightfield{};
}

std::size_t noDataOf(const RasterHeightfield& field) {
  return static_cast<std::size_t>(
      std::count_if(field.heights.begin(), field.heights.end(), [](double z) { return std::isnan(z); }));
}

/// Samples of the eight-connected NODATA region around the first void.
std::size_t firstVoidSize(const RasterHeightfield& field) {
  const auto first =
      std::find_if(field.heights.begin(), field.heights.end(), [](double z) { return std::isnan(z); });
  std::vector<std::int64_t> open = {first - field.heights.begin()};
  std::vector<bool> seen(field.size());
  seen[std::size_t(open[0])] = true;
  std::size_t count = 0;
  const std::int64_t w = field.columns;
  while (!open.empty()) {
    const std::int64_t at = open.back();
    open.pop_back();
    ++count;
    for (const std::int64_t offset :
         {-w - 1, -w, -w + 1, std::int64_t(-1), std::int64_t(1), w - 1, w, w + 1}) {
      const std::int64_t next = at + offset;
      if (next < 0 || next >= std::int64_t(field.size()) || seen[std::size_t(next)]) continue;
      if (!std::isnan(field.heights[std::size_t(next)])) continue;
      seen[std::size_t(next)] = true;
      open.push_back(next);
    }
  }
  return count;
}

TEST(TerrainGenerator, MakesTheSameBitsOnEveryMachine) {
  EXPECT_EQ(generate(193, 129, 1).sourceChecksum, "xxh3-128:0781b8afb2b39d7b09377766040fcb97");
  EXPECT_EQ(generate(300, 300, 42).sourceChecksum, "xxh3-128:b16ec3c281ce43b9fbd8a97475b66fcc");
}

TEST(TerrainGenerator, DoesNotDependOnTheNumberOfThreads) {
  const std::string one = generate(161, 161, 3, true, true, 1).sourceChecksum;
  EXPECT_EQ(generate(161, 161, 3, true, true, 2).sourceChecksum, one);
  EXPECT_EQ(generate(161, 161, 3, true, true, 4).sourceChecksum, one);
}

TEST(TerrainGenerator, MakesMountainsWithACoastAndALake) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const RasterHeightfield field = generate(257, 257, seed);
    SCOPED_TRACE(seed);
    ASSERT_TRUE(field.validate());
    double highest = 0;
    std::size_t sea = 0;
    for (const double z : field.heights) {
      if (std::isnan(z)) continue;
      ASSERT_GE(z, 0);
      highest = std::max(highest, z);
      sea += z == 0;
    }
    EXPECT_GT(highest, 400);
    EXPECT_LT(highest, 5000);
    EXPECT_GT(sea, field.size() / 50);
    EXPECT_LT(sea, field.size() / 2);
    const std::size_t lake = noDataOf(field);
    EXPECT_GT(lake, field.size() / 400);
    EXPECT_LT(lake, field.size() / 50);
    EXPECT_EQ(firstVoidSize(field), lake) << "the lake is not in one piece";
  }
}

TEST(TerrainGenerator, LeavesOutLakeAndSeaWhenAsked) {
  const RasterHeightfield field = generate(129, 129, 5, false, false);
  EXPECT_EQ(noDataOf(field), 0u);
  EXPECT_EQ(std::count(field.heights.begin(), field.heights.end(), 0.0), 0);
}

TEST(TerrainGenerator, MakesHeightsThatAFloatHolds) {
  for (const double z : generate(129, 129, 6, false).heights)
    ASSERT_EQ(static_cast<double>(static_cast<float>(z)), z);
}

TEST(TerrainGenerator, KnowsWhereItIs) {
  const RasterHeightfield field = generate(33, 17, 1);
  EXPECT_EQ(field.columns, 33u);
  EXPECT_EQ(field.rows, 17u);
  EXPECT_TRUE(field.georeference.hasGeoTransform);
  EXPECT_EQ(field.georeference.geoTransform[1], 30);
  EXPECT_EQ(field.georeference.verticalUnit, "m");
  EXPECT_NE(field.georeference.crsWkt.find("32632"), std::string::npos);
}

TEST(TerrainGenerator, RefusesSizesItCannotMake) {
  for (const auto& [columns, rows] : {std::pair{4u, 100u}, {100u, 0u}, {20000u, 100u}}) {
    TerrainOptions options;
    options.columns = columns;
    options.rows = rows;
    const auto field = generateTerrain(options);
    ASSERT_FALSE(field);
    EXPECT_EQ(field.error().code, ErrorCode::usage);
  }
  TerrainOptions options;
  options.pixelMetres = -1;
  EXPECT_FALSE(generateTerrain(options));
}

TEST(TerrainGenerator, StopsWhenAsked) {
  std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  const auto field = generateTerrain({}, context);
  ASSERT_FALSE(field);
  EXPECT_EQ(field.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace arete
