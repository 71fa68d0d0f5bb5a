// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every derived answer against a plain scan of the arrays.
#include "engine/mt/multitriangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/family_models.h"

namespace arete {
namespace {

TEST(MultiTriangulation, FindsTheCreatorOfEveryTriangle) {
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t)
      EXPECT_FALSE(mt.creator(TriangleId(t)).isValid());
    std::uint32_t t = mt.rootTriangleCount();
    for (std::uint32_t n = 0; n < mt.nodeCount(); ++n)
      for (std::uint32_t slot = 0; slot < mt.slotCount(NodeId(n)); ++slot, ++t) {
        ASSERT_EQ(mt.creator(TriangleId(t)), NodeId(n)) << m.name;
        ASSERT_EQ(mt.slotTriangle(NodeId(n), slot), TriangleId(t)) << m.name;
      }
    EXPECT_EQ(t, mt.triangleIdCount()) << m.name;
  }
}

TEST(MultiTriangulation, AnswersForOneElementAsItsArraysDo) {
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    const MtArrays& a = mt.arrays();
    EXPECT_EQ(mt.scale().base(), a.scale.base());
    EXPECT_EQ(mt.metric().scale.z, a.metric.scale.z);
    EXPECT_EQ(mt.rootTriangles().data(), a.rootTriangles.data());
    EXPECT_EQ(mt.slotTotal(), a.link.size());
    for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t) {
      ASSERT_EQ(mt.errorCode(TriangleId(t)), a.error[t]) << m.name;
      ASSERT_EQ(mt.decoded(kBelow, TriangleId(t)), a.scale.decode(mt.column(kBelow)[t])) << m.name;
    }
    for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) {
      ASSERT_EQ(mt.firstSlot(NodeId(n)), a.slotBegin[n]) << m.name;
      ASSERT_EQ(mt.saturatedCode(NodeId(n)), a.saturatedError[n]) << m.name;
      ASSERT_EQ(&mt.sphere(NodeId(n)), &a.sphere[n]) << m.name;
    }
  }
}

TEST(MultiTriangulation, HasTheCornersOfAStarAroundItsApex) {
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) {
      const NodeId node(n);
      const auto link = mt.link(node);
      EXPECT_EQ(mt.ceilingSize(node), link.size() - (mt.isOpen(node) ? 1 : 0));
      EXPECT_EQ(mt.floor(node).size() + 2, link.size());
      for (std::uint32_t i = 0; i < mt.ceilingSize(node); ++i) {
        const auto corners = mt.corners(mt.slotTriangle(node, i));
        EXPECT_EQ(corners[0], mt.apex(node).index());
        EXPECT_EQ(corners[1], link[i]);
        EXPECT_EQ(corners[2], link[(i + 1) % link.size()]);
        EXPECT_LT(corners[1], corners[0]) << "links name older vertices";
        EXPECT_LT(corners[2], corners[0]) << "links name older vertices";
      }
    }
  }
}

TEST(MultiTriangulation, IsTheOnlyRemoverAndTheOnlyCreatorOfAFloorTriangle) {
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    std::vector<int> removed(mt.triangleIdCount(), 0);
    for (std::uint32_t n = 0; n < mt.nodeCount(); ++n)
      for (const std::uint32_t t : mt.floor(NodeId(n))) {
        ++removed[t];
        EXPECT_EQ(mt.remover(TriangleId(t)), NodeId(n)) << m.name;
      }
    for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t) {
      EXPECT_LE(removed[t], 1) << m.name;
      const NodeId remover = mt.remover(TriangleId(t));
      // The last slot of an open star is removed by its own node.
      const bool isMissing = remover.isValid() && remover == mt.creator(TriangleId(t));
      EXPECT_EQ(removed[t] == 1, remover.isValid() && !isMissing) << m.name;
    }
  }
}

TEST(MultiTriangulation, CountsTrianglesOfPrefixesAndOfAll) {
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    std::uint32_t front = mt.rootTriangleCount();
    std::uint64_t all = mt.rootTriangleCount();
    for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) {
      EXPECT_EQ(mt.prefixTriangleCount(n), front) << m.name;
      front += mt.ceilingSize(NodeId(n)) - static_cast<std::uint32_t>(mt.floor(NodeId(n)).size());
      all += mt.ceilingSize(NodeId(n));
    }
    EXPECT_EQ(mt.finestTriangleCount(), front) << m.name;
    EXPECT_EQ(mt.triangleCount(), all) << m.name;
  }
}

TEST(MultiTriangulation, HasItsNodesInFallingBands) {
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    std::uint32_t before = 0;
    for (std::uint32_t band = MultiTriangulation::kBands; band-- > 0;) {
      EXPECT_EQ(mt.bandBegin(band), before) << m.name;
      for (std::uint32_t n = mt.bandBegin(band); n < mt.bandEnd(band); ++n)
        EXPECT_EQ(MultiTriangulation::bandOf(mt.arrays().saturatedError[n]), band) << m.name;
      before = mt.bandEnd(band);
    }
    EXPECT_EQ(before, mt.nodeCount()) << m.name;
    double largest = 0;
    for (std::uint32_t n = 0; n < mt.nodeCount(); ++n)
      largest = std::max(largest, mt.saturatedError(NodeId(n)));
    EXPECT_EQ(mt.largestError(), largest) << m.name;
  }
}

TEST(MultiTriangulation, StaysAliveAsLongAsACopyOfIt) {
  auto owner = std::make_shared<std::vector<std::array<std::uint32_t, 3>>>();
  owner->push_back({0, 1, 2});
  MtArrays a;
  a.rootVertices = 3;
  a.rootTriangles = *owner;
  const std::vector<std::uint32_t> remover = {MultiTriangulation::kNone}, begin = {0};
  a.remover = remover;
  a.slotBegin = begin;
  const std::weak_ptr<const void> watched = owner;
  auto mt = std::make_unique<MultiTriangulation>(a, owner);
  owner.reset();
  auto copy = std::make_unique<MultiTriangulation>(*mt);
  mt.reset();
  EXPECT_FALSE(watched.expired());
  EXPECT_EQ(copy->corners(TriangleId(0)), (std::array<std::uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(copy->triangleCount(), 1u);
  EXPECT_EQ(copy->largestError(), 0);
  copy.reset();
  EXPECT_TRUE(watched.expired());
}

}  // namespace
}  // namespace arete
