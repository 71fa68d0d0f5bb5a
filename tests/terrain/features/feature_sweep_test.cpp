// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of a sweep: its orders, its trees against a map of roots, its pairs on a profile.
#include "terrain/features/feature_sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace arete {
namespace {

TEST(LowerVertex, OrdersByHeightAndThenByIndex) {
  const std::vector<double> heights = {3, 1, 3, 2, 1};
  std::vector<std::uint32_t> order(heights.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, LowerVertex(heights));
  EXPECT_EQ(order, (std::vector<std::uint32_t>{1, 4, 3, 0, 2}));
  std::ranges::sort(order, HigherVertex(heights));
  EXPECT_EQ(order, (std::vector<std::uint32_t>{2, 0, 3, 4, 1}));
  EXPECT_FALSE(LowerVertex(heights)(2, 2));
}

TEST(FeatureTrees, FindTheRootsThatAttachingGivesThem) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    constexpr std::uint32_t kCount = 300;
    // Parents in a random order of the vertices; the first of the order and some others are roots.
    std::vector<std::uint32_t> order(kCount), root(kCount);
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::shuffle(order, random);
    UninitializedVector<std::uint32_t> parent(kCount);
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const bool isRoot = i == 0 || random() % 8 == 0;
      parent[order[i]] = isRoot ? order[i] : order[random() % i];
      root[order[i]] = isRoot ? order[i] : root[parent[order[i]]];
    }
    FeatureTrees trees(std::move(parent));
    for (std::uint32_t v = 0; v < kCount; ++v) ASSERT_EQ(trees.tree(v), root[v]);
    for (int joins = 0; joins < 20; ++joins) {
      const std::uint32_t a = root[random() % kCount], b = root[random() % kCount];
      if (a == b) continue;
      trees.attach(a, b);
      std::ranges::replace(root, a, b);
      for (std::uint32_t v = 0; v < kCount; ++v) ASSERT_EQ(trees.find(v), root[v]);
    }
  }
}

/// The vertices of a profile, each attached to a lower neighbour.
FeatureTrees treesOfProfile(const std::vector<double>& heights) {
  const LowerVertex isLower(heights);
  UninitializedVector<std::uint32_t> parent(heights.size());
  for (std::uint32_t v = 0; v < heights.size(); ++v) {
    parent[v] = v;
    if (v > 0 && isLower(v - 1, v)) parent[v] = v - 1;
    if (v + 1 < heights.size() && isLower(v + 1, v)) parent[v] = v + 1;
  }
  return FeatureTrees(std::move(parent));
}

TEST(SweepFeatures, PairsTheYoungerPitWithThePassThatJoinsIt) {
  // Pits 1, 0, 3 at the indices 0, 2, 4; passes 5 and 8.
  const std::vector<double> heights = {1, 5, 0, 8, 3, 9};
  FeatureTrees trees = treesOfProfile(heights);
  std::vector<FeatureLink> links = {{3, 2}, {3, 4}, {1, 0}, {1, 2}};
  std::vector<Feature> found;
  sweepFeatures(trees, links, LowerVertex(heights), Feature::Kind::pit, heights, {}, found);
  const std::vector<Feature> expected = {{Feature::Kind::pit, 0, 1, 4},
                                         {Feature::Kind::pass, 1, 5, 4},
                                         {Feature::Kind::pit, 4, 3, 5},
                                         {Feature::Kind::pass, 3, 8, 5}};
  EXPECT_EQ(found, expected);
  for (std::uint32_t v = 0; v < heights.size(); ++v) EXPECT_EQ(trees.find(v), 2u) << "the lowest pit remains";

  found.clear();
  trees = treesOfProfile(heights);
  sweepFeatures(trees, links, LowerVertex(heights), Feature::Kind::pit, heights, {.minimumPersistence = 4.5},
                found);
  EXPECT_EQ(found, std::vector<Feature>(expected.begin() + 2, expected.end()));
}

TEST(RankFeatures, AppendsTheExtremesOfEachComponentAndSorts) {
  const std::vector<double> heights = {1, 5, 0, 8, 3, 9};
  const auto firstNeighbours = [&](const auto& before) {
    UninitializedVector<std::uint32_t> parent(heights.size());
    for (std::uint32_t v = 0; v < heights.size(); ++v) {
      parent[v] = v;
      if (v > 0 && before(v - 1, parent[v])) parent[v] = v - 1;
      if (v + 1 < heights.size() && before(v + 1, parent[v])) parent[v] = v + 1;
    }
    return parent;
  };
  FeatureParents parents{firstNeighbours(LowerVertex(heights)), firstNeighbours(HigherVertex(heights))};
  const auto allEdges = [&](const auto& before, const FeatureTrees&) {
    std::vector<FeatureLink> links;
    for (std::uint32_t v = 1; v < heights.size(); ++v)
      links.push_back(before(v - 1, v) ? FeatureLink{v, v - 1} : FeatureLink{v - 1, v});
    return links;
  };
  const std::vector<Feature> ranked = rankFeaturesOf(heights, std::move(parents), allEdges, {}, {});
  using Kind = Feature::Kind;
  // Pits as above. The peaks 5 and 8 join higher ones over the passes 0 and 3, 5 lower in both cases.
  const std::vector<Feature> expected = {{Kind::pit, 2, 0, 9},  {Kind::peak, 5, 9, 9}, {Kind::peak, 1, 5, 5},
                                         {Kind::pass, 2, 0, 5}, {Kind::peak, 3, 8, 5}, {Kind::pass, 3, 8, 5},
                                         {Kind::pit, 4, 3, 5},  {Kind::pass, 4, 3, 5}, {Kind::pit, 0, 1, 4},
                                         {Kind::pass, 1, 5, 4}};
  EXPECT_EQ(ranked, expected);
}

}  // namespace
}  // namespace arete
