// SPDX-License-Identifier: GPL-3.0-or-later
//
// The states between two random cuts are sets of nodes, tested for closure one by one.
#include "engine/follow/cut_difference.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "engine/cut_promises.h"
#include "engine/family_models.h"
#include "engine/follow/incremental_cut.h"

namespace arete {
namespace {

TEST(CutDifference, LeadsThereThroughCutsOnlyAndBackAgain) {
  std::mt19937_64 random(15);
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    const auto randomCut = [&] {
      NodeSet set(mt.nodeCount(), 0);
      for (std::uint32_t i = 0; i < mt.nodeCount() / 30 + 1 && mt.nodeCount() > 0; ++i)
        set[random() % mt.nodeCount()] = 1;
      closeUpwards(mt, set);
      return set;
    };
    const NodeSet from = randomCut(), to = randomCut();
    const std::vector<CutStep> steps = difference(from, to);
    std::size_t differing = 0;
    for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) differing += from[n] != to[n] ? 1 : 0;
    EXPECT_EQ(steps.size(), differing) << m.name;
    NodeSet set = from;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      applySteps({&steps[i], 1}, set);
      NodeSet closed = set;
      closeUpwards(mt, closed);
      ASSERT_EQ(closed, set) << m.name << " step " << i;
    }
    EXPECT_EQ(set, to) << m.name;
    applySteps(undone(steps), set);
    EXPECT_EQ(set, from) << m.name;
    IncrementalCut cut(mt);
    ASSERT_TRUE(cut.apply(difference(NodeSet(mt.nodeCount(), 0), from))) << m.name;
    ASSERT_TRUE(cut.apply(steps)) << m.name;
    EXPECT_EQ(cut.nodes(), to) << m.name;
    ASSERT_TRUE(cut.apply(undone(std::vector<CutStep>(cut.lastSteps().begin(), cut.lastSteps().end()))));
    EXPECT_EQ(cut.nodes(), from) << m.name;
  }
}

TEST(CutDifference, BetweenEqualCutsIsEmpty) {
  const NodeSet set = {1, 0, 1};
  EXPECT_TRUE(difference(set, set).empty());
  EXPECT_TRUE(undone({}).empty());
}

TEST(CutDifference, UndoesChildrenFirstAndAppliesParentsFirst) {
  const std::vector<CutStep> expected = {
      {NodeId(3), false}, {NodeId(1), false}, {NodeId(0), true}, {NodeId(2), true}};
  EXPECT_EQ(difference({0, 1, 0, 1}, {1, 0, 1, 0}), expected);
  const std::vector<CutStep> back = {
      {NodeId(2), false}, {NodeId(0), false}, {NodeId(1), true}, {NodeId(3), true}};
  EXPECT_EQ(undone(expected), back);
}

}  // namespace
}  // namespace arete
