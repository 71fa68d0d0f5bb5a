// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/features/features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <utility>

#include "terrain/feature_surface.h"

namespace arete {
namespace {

using namespace features_test;

// Two mountains of 100 and 70 m on a sea at 0, joined by a ridge whose lowest point lies at 40 m.
Surface twoPeaks() {
  return Surface(21, 11, [](double c, double r) {
    const double ridge = c <= 5    ? 100 * c / 5
                         : c <= 10 ? 100 - 12 * (c - 5)
                         : c <= 15 ? 40 + 6 * (c - 10)
                                   : 70 * (20 - c) / 5;
    return ridge * (1 - std::abs(r - 5) / 5);
  });
}

TEST(Features, FindsOnePeakOnACone) {
  const Surface s(11, 11, [](double c, double r) { return 50 - std::hypot(c - 5, r - 5); });
  const auto ranked = s.rank();
  ASSERT_EQ(count(ranked, Kind::peak), 1u);
  const double range = s.heights[s.at(5, 5)] - s.heights[0];
  EXPECT_TRUE(std::find(ranked.begin(), ranked.end(), feature(s, Kind::peak, s.at(5, 5), range)) !=
              ranked.end());
  // Its square border has a pit at each corner, and a high point at each middle between them that spills it.
  EXPECT_EQ(count(ranked, Kind::pit), 4u);
  EXPECT_EQ(count(ranked, Kind::pass), 3u);
}

TEST(Features, GivesALowerSummitItsProminence) {
  const Surface s = twoPeaks();
  const std::vector<Feature> expected = {
      feature(s, Kind::pit, s.at(0, 0), 100), feature(s, Kind::peak, s.at(5, 5), 100),
      feature(s, Kind::pass, s.at(10, 5), 30), feature(s, Kind::peak, s.at(15, 5), 30)};
  EXPECT_EQ(s.rank(), expected);
}

TEST(Features, GivesACraterTheDepthToItsLowestRim) {
  // A ring wall of 80 m around a floor of 20 m, notched down to 75 m at one place.
  Surface s(21, 21, [](double c, double r) {
    return std::max(0.0, 80 - 12 * std::abs(std::max(std::abs(c - 10), std::abs(r - 10)) - 5));
  });
  s.heights[s.at(15, 10)] = 75;
  const auto ranked = s.rank();
  const auto pit = std::find_if(ranked.begin(), ranked.end(), [&](const Feature& f) {
    return f.kind == Kind::pit && f.sample == s.at(10, 10);
  });
  ASSERT_NE(pit, ranked.end());
  EXPECT_DOUBLE_EQ(pit->height, 20);
  EXPECT_DOUBLE_EQ(pit->persistence, 55);
  EXPECT_TRUE(std::find(ranked.begin(), ranked.end(), feature(s, Kind::pass, s.at(15, 10), 55)) !=
              ranked.end());
}

TEST(Features, GivesAPlateauOnePeak) {
  const Surface s(13, 13, [](double c, double r) {
    return std::min(3.0, 6 - std::max(std::abs(c - 6), std::abs(r - 6)));
  });
  const std::vector<Feature> expected = {feature(s, Kind::pit, 0, 3), feature(s, Kind::peak, s.at(9, 9), 3)};
  EXPECT_EQ(s.rank(), expected);
}

TEST(Features, FindsNothingOnFlatGround) {
  EXPECT_TRUE(Surface(8, 5, [](double, double) { return 12.5; }).rank().empty());
  EXPECT_TRUE(rankFeatures(std::vector<double>{}, {}).empty());
  EXPECT_TRUE(rankFeatures(std::vector<double>{1, 2, kNone}, {}).empty())
      << "isolated samples have no features";
}

TEST(Features, RanksEachComponentBesideNodataByItself) {
  // A strip of NODATA parts a range of 10 m from one of 4 m.
  const Surface s(9, 4, [](double c, double) {
    return c == 4 ? kNone : c < 4 ? 10 * c / 3 : 100 + 4 * (c - 5) / 3;
  });
  const auto ranked = s.rank();
  ASSERT_EQ(ranked.size(), 4u);
  EXPECT_DOUBLE_EQ(ranked[0].persistence, 10);
  EXPECT_DOUBLE_EQ(ranked[1].persistence, 10);
  EXPECT_DOUBLE_EQ(ranked[2].persistence, 4);
  EXPECT_DOUBLE_EQ(ranked[3].persistence, 4);
  EXPECT_EQ(count(ranked, Kind::peak), 2u);
  EXPECT_EQ(count(ranked, Kind::pit), 2u);
}

TEST(Features, AgreeWithFloodingOnRandomSurfaces) {
  std::mt19937 random(20021128);
  for (int trial = 0; trial < 120; ++trial) {
    const std::uint32_t columns = 2 + random() % 11, rows = 2 + random() % 11;
    const unsigned levels = trial % 3 == 0 ? 4 : trial % 3 == 1 ? 25 : 1000000;  // plateaus, some, none
    const unsigned holes = trial % 2 == 0 ? 0 : 20;
    const Surface s(columns, rows, [&](double, double) {
      return random() % 100 < holes ? kNone : double(random() % levels);
    });
    const auto expected = rankByFlooding(s);
    EXPECT_EQ(s.rank(), expected) << "trial " << trial;
    EXPECT_EQ(s.rankAsRaster(), expected) << "trial " << trial;
  }
}

// Euler: on a sphere pits - passes + peaks = 2. A surface becomes one when a vertex below everything is
// joined to its border, and its index is then 1: what is left counts pits - passes + peaks = 1 over the
// vertices of the terrain. The indices come from each vertex's ring alone (Banchoff 1967), the pairs from the
// sweeps.
TEST(Features, PassesBalancePeaksAndPits) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 20; ++trial) {
    // Random inside, and a border that falls all the way round, a sea's shore: no border pit but one.
    const std::uint32_t n = 14;
    const Surface s(n, n, [&](double c, double r) {
      const bool border = c == 0 || r == 0 || c == n - 1 || r == n - 1;
      return border ? -1.0 : double(random() % 1000000);
    });
    const auto ranked = s.rank();
    EXPECT_EQ(count(ranked, Kind::peak) + count(ranked, Kind::pit), count(ranked, Kind::pass) + 2);

    const auto neighbours = s.neighbours();
    const auto lower = [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(s.heights[a], a) < std::pair(s.heights[b], b);
    };
    std::size_t peaks = 0, pits = 0, saddles = 0;
    for (std::uint32_t r = 1; r + 1 < n; ++r) {
      for (std::uint32_t c = 1; c + 1 < n; ++c) {
        const std::uint32_t v = s.at(c, r);
        const std::array<std::uint32_t, 6> ring = {v + 1, v + n + 1, v + n, v - 1, v - n - 1, v - n};
        std::size_t changes = 0;
        for (int i = 0; i < 6; ++i) {
          ASSERT_TRUE(neighbours[v].contains(ring[i]));
          changes += lower(ring[i], v) != lower(ring[(i + 1) % 6], v);
        }
        if (changes == 0) ++(lower(ring[0], v) ? peaks : pits);
        if (changes > 2) saddles += changes / 2 - 1;
      }
    }
    EXPECT_EQ(count(ranked, Kind::peak), peaks);
    EXPECT_EQ(count(ranked, Kind::pit), pits + 1) << "the sea is the one pit without a ring";
    EXPECT_EQ(count(ranked, Kind::pass), saddles);
  }
}

TEST(Features, DoNotDependOnThreads) {
  std::mt19937 random(3);
  const Surface s(120, 90, [&](double, double) { return double(random() % 50); });
  RunContext one, four;
  one.threads = 1;
  four.threads = 4;
  EXPECT_EQ(s.rank({}, one), s.rank({}, four));
  EXPECT_EQ(s.rankAsRaster(one), s.rank({}, one));
  EXPECT_EQ(s.rankAsRaster(four), s.rank({}, one));
}

TEST(Features, StopWhenCancelled) {
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  EXPECT_TRUE(twoPeaks().rank({}, context).empty());
  EXPECT_TRUE(twoPeaks().rankAsRaster(context).empty());
}

TEST(Features, SelectionStopsAtTheCountAndAtThePersistence) {
  const Surface s = twoPeaks();
  const auto ranked = s.rank();
  EXPECT_EQ(selectFeatures(ranked, {.count = 3}),
            (std::vector<std::uint32_t>{s.at(0, 0), s.at(5, 5), s.at(10, 5)}));
  EXPECT_EQ(selectFeatures(ranked, {.minimumPersistence = 31}),
            (std::vector<std::uint32_t>{s.at(0, 0), s.at(5, 5)}));
  EXPECT_TRUE(selectFeatures(ranked, {.count = 0}).empty());
  EXPECT_EQ(s.rank({.minimumPersistence = 31}).size(), 2u);
}

TEST(Features, SelectionNamesAVertexOnce) {
  const std::vector<Feature> ranked = {{Kind::pass, 4, 1, 9}, {Kind::pass, 4, 1, 8}, {Kind::pit, 2, 1, 8}};
  EXPECT_EQ(selectFeatures(ranked, {.count = 2}), (std::vector<std::uint32_t>{4, 2}));
}

}  // namespace
}  // namespace arete
