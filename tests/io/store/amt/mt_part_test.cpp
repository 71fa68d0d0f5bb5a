// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/amt/mt_part.h"

#include <gtest/gtest.h>

#include "datasets/families.h"
#include "datasets/random.h"
#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "io/amt_fixture.h"
#include "io/store/amt/index_check.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

using test::built;

constexpr std::uint32_t kPage = MultiTriangulation::kNodesPerPage;

TerrainModel largerModel() {
  return built(build(test::hills(120, 90, [](double z) { return std::round(z); })));
}

/// Some nodes, drawn by chance, with all of their parents.
RankedNodes someNodes(const MultiTriangulation& mt, std::uint32_t oneOf, std::uint64_t seed) {
  Random random(seed);
  RankedNodes nodes(mt.nodeCount());
  for (std::uint32_t n = 0; n < mt.nodeCount(); ++n)
    if (random.below(oneOf) == 0) nodes.add(n);
  EXPECT_TRUE(addParents(mt, nodes));
  nodes.rank();
  return nodes;
}

TEST(MtPart, APrefixKeepsItsNumbersAndPassesTheCheck) {
  const TerrainModel model = largerModel();
  const MtArrays& a = model.mt.arrays();
  for (std::uint32_t nodes = 0; nodes <= model.mt.nodeCount(); nodes += kPage) {
    const auto part = prefixOfMt(model.mt, nodes);
    ASSERT_TRUE(part) << nodes;
    EXPECT_EQ(part->nodeCount(), nodes);
    EXPECT_TRUE(checkMtIndices(*part, 120 * 90)) << nodes;
    EXPECT_EQ(part->finestTriangleCount(), model.mt.prefixTriangleCount(nodes));
    EXPECT_EQ(part->arrays().link.data(), a.link.data());
  }
  EXPECT_EQ(prefixOfMt(model.mt, model.mt.nodeCount())->arrays().remover.data(), a.remover.data());
}

TEST(MtPart, ASubsetHasItsNodesInTheirOrderAndPassesTheCheck) {
  const TerrainModel model = largerModel();
  for (const std::uint32_t oneOf : {2u, 50u, 1000u}) {
    SCOPED_TRACE(oneOf);
    const RankedNodes nodes = someNodes(model.mt, oneOf, oneOf);
    const MtSubset part = subsetOfMt(model.mt, nodes);
    ASSERT_EQ(part.problem, MtSubset::Problem::none);
    EXPECT_EQ(part.mt.nodeCount(), nodes.size());
    EXPECT_TRUE(checkMtIndices(part.mt, 120 * 90));
    std::uint32_t rank = 0;
    for (std::uint32_t n = 0; n < model.mt.nodeCount(); ++n) {
      if (!nodes.contains(n)) continue;
      const NodeId from(n), to(rank++);
      ASSERT_EQ(part.mt.position(part.mt.apex(to)), model.mt.position(model.mt.apex(from)));
      ASSERT_EQ(part.mt.slotCount(to), model.mt.slotCount(from));
      ASSERT_EQ(part.mt.arrays().saturatedError[to.index()], model.mt.arrays().saturatedError[n]);
      for (std::uint32_t i = 0; i < part.mt.slotCount(to); ++i)
        ASSERT_EQ(part.mt.position(VertexId(part.mt.link(to)[i])),
                  model.mt.position(VertexId(model.mt.link(from)[i])));
    }
  }
}

TEST(MtPart, ASubsetOfAllNodesIsTheWhole) {
  const TerrainModel model = largerModel();
  RankedNodes nodes(model.mt.nodeCount());
  for (std::uint32_t n = 0; n < model.mt.nodeCount(); ++n) nodes.add(n);
  nodes.rank();
  const MtSubset part = subsetOfMt(model.mt, nodes);
  ASSERT_EQ(part.problem, MtSubset::Problem::none);
  test::expectSameArray(part.mt.arrays().link, model.mt.arrays().link, "link");
  test::expectSameArray(part.mt.arrays().remover, model.mt.arrays().remover, "remover");
  test::expectSameArray(part.mt.arrays().floor, model.mt.arrays().floor, "floor");
  test::expectSameArray(part.mt.arrays().creatorHint, model.mt.arrays().creatorHint, "hints");
}

TEST(MtPart, OfNodesWithoutTheirParentsSaysSo) {
  const TerrainModel model = test::tinyModel();
  RankedNodes nodes(2);
  nodes.add(1);
  nodes.rank();
  EXPECT_EQ(subsetOfMt(model.mt, nodes).problem, MtSubset::Problem::parentMissing);
  EXPECT_TRUE(addParents(model.mt, nodes));
  nodes.rank();
  EXPECT_EQ(nodes.size(), 2u);
  EXPECT_EQ(subsetOfMt(model.mt, nodes).problem, MtSubset::Problem::none);
}

TEST(MtPart, OfDamagedArraysIsRefusedOrHasItsSizes) {
  const TerrainModel model = largerModel();
  Random random(7);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    MtArrays a = model.mt.arrays();
    std::vector<std::uint32_t> slotBegin(a.slotBegin.begin(), a.slotBegin.end()),
        floor(a.floor.begin(), a.floor.end()), link(a.link.begin(), a.link.end()),
        hint(a.creatorHint.begin(), a.creatorHint.end());
    std::vector<std::uint32_t>& chosen = i % 4 == 0   ? slotBegin
                                         : i % 4 == 1 ? floor
                                         : i % 4 == 2 ? link
                                                      : hint;
    chosen[random.below(static_cast<std::uint32_t>(chosen.size()))] =
        static_cast<std::uint32_t>(random.next());
    a.slotBegin = slotBegin;
    a.floor = floor;
    a.link = link;
    a.creatorHint = hint;
    const MultiTriangulation broken(a, nullptr);
    RankedNodes nodes(broken.nodeCount());
    for (std::uint32_t n = 0; n < broken.nodeCount(); ++n)
      if (random.below(3) == 0) nodes.add(n);
    if (!addParents(broken, nodes)) {
      ++refused;
      continue;
    }
    nodes.rank();
    const MtSubset part = subsetOfMt(broken, nodes);
    if (part.problem != MtSubset::Problem::none) {
      ++refused;
      continue;
    }
    EXPECT_EQ(part.mt.nodeCount(), nodes.size());
    static_cast<void>(checkMtIndices(part.mt, 120 * 90));
  }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace arete
