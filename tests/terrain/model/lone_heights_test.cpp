// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/model/lone_heights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "datasets/families.h"

namespace arete {
namespace {

/// Heights from `low` to `high` in `count` even steps.
std::vector<double> evenly(double low, double high, std::size_t count) {
  std::vector<double> heights;
  for (std::size_t i = 0; i < count; ++i)
    heights.push_back(low + (high - low) * double(i) / double(count - 1));
  return heights;
}

void put(std::vector<double>& heights, double value, std::size_t count) {
  heights.insert(heights.begin() + std::ptrdiff_t(heights.size() / 2), count, value);
}

struct Case {
  const char* what;
  double low, high;
  std::vector<std::pair<double, std::size_t>> planted;
  std::size_t expected;
};

TEST(LoneHeights, AreFoundByTheirDistance) {
  const std::vector<Case> cases = {
      {"SRTM voids that are not declared", 0, 4000, {{-32768, 120}}, 120},
      {"-9999 below a world of land", -420, 8848, {{-9999, 700}}, 700},
      {"two marks", 0, 3000, {{-32768, 3}, {-9999, 5}}, 8},
      {"marks on both sides", 0, 3000, {{-9999, 3}, {1e20, 5}}, 8},
      {"the lowest float, as sea in a float DEM", 0, 800, {{-3.4028234663852886e+38, 400}}, 400},
      {"netCDF's fill value", -100, 90, {{9.969209968386869e+36, 1}}, 1},
      {"a pixel of 32767 m", 200, 900, {{32767, 1}}, 1},
      {"zeros below a plateau", 300, 400, {{0, 300}}, 300},
      {"nothing", 0, 4000, {}, 0},
      {"a mast", 0, 20, {{45, 1}}, 0},
      {"sea and an island", 0, 900, {{0, 900}}, 0},
      {"-9999 where the sea is as deep", -10900, 8848, {{-9999, 5}}, 0},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    std::vector<double> heights = evenly(c.low, c.high, 1000);
    for (const auto& [value, count] : c.planted) put(heights, value, count);
    heights.push_back(std::numeric_limits<double>::quiet_NaN());
    const LoneHeights lone = loneHeights(heights);
    EXPECT_EQ(lone.count, c.expected);
    if (c.expected == 0) continue;
    EXPECT_EQ(lone.low, c.low);
    EXPECT_EQ(lone.high, c.high);
    EXPECT_EQ(lone.values.size(), c.planted.size());
    const std::string sentence = describe(lone);
    EXPECT_NE(sentence.find("`nodata`"), std::string::npos) << sentence;
  }
}

TEST(LoneHeights, AreNamedByTheirRawValue) {
  std::vector<double> heights = evenly(-10, 250, 500);
  put(heights, -32768 * 0.1 + 5, 7);
  const LoneHeights lone = loneHeights(heights, 0.1, 5);
  EXPECT_EQ(lone.count, 7u);
  EXPECT_EQ(
      describe(lone, 0.1, 5),
      "the value -32768 occurs 7 times, far from the other heights, from -10 to 250; if it marks missing "
      "data, state it: `nodata` -32768");
}

TEST(LoneHeights, OfManyValuesAreCounted) {
  std::vector<double> heights = evenly(0, 100, 20000);
  for (int i = 0; i < 12; ++i) put(heights, 5000 + i, 1);
  const LoneHeights lone = loneHeights(heights);
  EXPECT_EQ(lone.count, 12u);
  EXPECT_TRUE(lone.values.empty());
  EXPECT_EQ(lone.lowest, 5000);
  EXPECT_EQ(lone.highest, 5011);
  EXPECT_FALSE(lone.areRemote());
}

TEST(LoneHeights, AreNoneWithoutSamplesOrOnLevelGround) {
  EXPECT_EQ(loneHeights({}).count, 0u);
  const std::vector<double> level(200, 12.5), nothing(200, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(loneHeights(level).count, 0u);
  EXPECT_EQ(loneHeights(nothing).count, 0u);
  std::vector<double> house = level;
  house[100] = 20;
  EXPECT_EQ(loneHeights(house).count, 0u);
  house[100] = 1e20;
  EXPECT_EQ(loneHeights(house).count, 1u);
  EXPECT_TRUE(loneHeights(house).areRemote());
}

}  // namespace
}  // namespace arete
