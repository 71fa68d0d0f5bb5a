// SPDX-License-Identifier: GPL-3.0-or-later
//
// Made of random spheres and errors; what a block has to contain is checked node by node.
#include "engine/mt/node_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace arete {
namespace {

constexpr std::uint32_t kPerBlock = MultiTriangulation::kNodesPerBlock,
                        kPerPage = MultiTriangulation::kNodesPerPage;

struct Nodes {
  std::vector<Sphere> sphere;
  std::vector<OutwardScale::Code> error;
  NodeBlocks blocks;

  Nodes(std::size_t count, double size, std::mt19937_64& random) {
    std::uniform_real_distribution<float> unit(0, 1);
    for (std::size_t i = 0; i < count; ++i) {
      const auto s = static_cast<float>(size);
      sphere.push_back({s * unit(random), s * unit(random), s * unit(random), 0.1f * s * unit(random)});
      error.push_back(static_cast<OutwardScale::Code>(random()));
    }
    blocks = makeNodeBlocks(error, sphere);
  }
  MtArrays arrays() const {
    MtArrays a;
    a.sphere = sphere;
    a.saturatedError = error;
    a.blockSphere = blocks.sphere;
    a.blockError = blocks.error;
    return a;
  }
};

TEST(NodeBlocks, ContainEveryNodesSphereAndErrorInItsBlockAndItsPage) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    for (const std::size_t count : {1u, 63u, 64u, 65u, 1023u, 1024u, 1025u, 5000u}) {
      const Nodes nodes(count, std::pow(10, double(random() % 13) - 6), random);
      const MtArrays a = nodes.arrays();
      ASSERT_EQ(a.blockSphere.size(), nodeBlockAndPageCount(count));
      ASSERT_EQ(a.blockError.size(), nodeBlockAndPageCount(count));
      for (std::uint32_t n = 0; n < count; ++n)
        for (const std::uint64_t entry : blockEntries(count, n)) {
          EXPECT_TRUE(holdsError(a, entry, n)) << count << " nodes, node " << n;
          EXPECT_TRUE(holdsSphere(a, entry, n)) << count << " nodes, node " << n;
        }
    }
  }
}

TEST(NodeBlocks, HaveTheLargestErrorOfTheirNodesAndNoMore) {
  std::mt19937_64 random(4);
  const Nodes nodes(3000, 1, random);
  const auto largest = [&](std::size_t begin, std::size_t size) {
    OutwardScale::Code most = 0;
    for (std::size_t n = begin; n < std::min<std::size_t>(3000, begin + size); ++n)
      most = std::max(most, nodes.error[n]);
    return most;
  };
  const std::size_t blocks = nodeBlockCount(3000);
  for (std::size_t i = 0; i < blocks; ++i)
    EXPECT_EQ(nodes.blocks.error[i], largest(i * kPerBlock, kPerBlock));
  for (std::size_t i = blocks; i < nodes.blocks.error.size(); ++i)
    EXPECT_EQ(nodes.blocks.error[i], largest((i - blocks) * kPerPage, kPerPage));
}

TEST(NodeBlocks, HaveABallHardlyLargerThanThatOfASingleNode) {
  const std::vector<Sphere> one = {{3, -4, 5, 2}};
  const std::vector<OutwardScale::Code> error = {7};
  const NodeBlocks made = makeNodeBlocks(error, one);
  ASSERT_EQ(made.sphere.size(), 2u);
  for (const Sphere& s : made.sphere) {
    EXPECT_EQ(s.x, 3);
    EXPECT_EQ(s.y, -4);
    EXPECT_EQ(s.z, 5);
    EXPECT_GE(s.radius, 2);
    EXPECT_LE(s.radius, 2 * (1 + 1e-5));
  }
}

TEST(NodeBlocks, FailTheTestsOfASphereOrAnErrorThatWasEnlarged) {
  std::mt19937_64 random(5);
  Nodes nodes(200, 10, random);
  nodes.sphere[150].radius = 1000;
  nodes.error[20] = 0xFFFF;
  nodes.blocks.error[0] = nodes.blocks.error[4] = 0xFFFE;
  const MtArrays a = nodes.arrays();
  for (const std::uint64_t entry : blockEntries(200, 150)) EXPECT_FALSE(holdsSphere(a, entry, 150));
  for (const std::uint64_t entry : blockEntries(200, 20)) EXPECT_FALSE(holdsError(a, entry, 20));
}

TEST(NodeBlocks, OfNoNodesAreNone) {
  EXPECT_EQ(nodeBlockCount(0), 0u);
  EXPECT_EQ(nodeBlockAndPageCount(0), 0u);
  EXPECT_TRUE(makeNodeBlocks({}, {}).sphere.empty());
  EXPECT_EQ(nodeBlockAndPageCount(65), 3u);
  EXPECT_EQ(nodeBlockAndPageCount(1025), 17u + 2u);
}

}  // namespace
}  // namespace arete
