// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle is the cut from scratch.
#include "engine/follow/incremental_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "engine/cut_promises.h"
#include "engine/family_models.h"

namespace arete {
namespace {

NodeSet fromScratch(const MultiTriangulation& mt, const Criterion& criterion) {
  return takeNodes(mt, criterion, {.method = CutMethod::saturated})->nodes;
}

TEST(IncrementalCut, StartsAtTheRoot) {
  const MultiTriangulation& mt = familyModels().front().model.mt;
  const IncrementalCut cut(mt);
  EXPECT_EQ(cut.nodeCount(), 0u);
  EXPECT_EQ(cut.triangles().size(), mt.rootTriangleCount());
  EXPECT_TRUE(cut.validate());
}

TEST(IncrementalCut, EqualsTheCutFromScratchAfterAThousandCameraMoves) {
  std::mt19937_64 random(8);
  std::size_t moves = 0;
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    const Extent extent(mt);
    IncrementalCut cut(mt);
    View view = randomView(extent, random);
    for (int move = 0; move < 40; ++move, ++moves) {
      if (move % 10 == 9) view = randomView(extent, random);  // a jump now and then
      std::normal_distribution<double> step(0, 0.02);
      view.eye = {view.eye.x + step(random) * extent.size(), view.eye.y + step(random) * extent.size(),
                  view.eye.z + step(random) * extent.relief()};
      view.forward.x += step(random), view.forward.y += step(random);
      const ViewError criterion({.view = view, .pixels = 1}, mt.arrays().metric);
      const auto update = cut.update(criterion);
      ASSERT_TRUE(update);
      EXPECT_TRUE(update->isComplete);
      EXPECT_EQ(cut.nodes(), fromScratch(mt, criterion)) << m.name << " move " << move;
    }
    EXPECT_TRUE(cut.validate()) << m.name;
  }
  EXPECT_GE(moves, 1000u);
}

TEST(IncrementalCut, EqualsTheCutFromScratchFromOneCriterionToAnother) {
  std::mt19937_64 random(9);
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    IncrementalCut cut(mt);
    for (int round = 0; round < 3; ++round)
      for (const auto& [name, criterion] : criteriaFor(mt, random)) {
        const auto update = cut.update(*criterion);
        ASSERT_EQ(update.has_value(), criterion->bounded() != nullptr) << name;
        if (!update) {
          EXPECT_EQ(update.error().code, ErrorCode::usage);
          continue;
        }
        EXPECT_EQ(cut.nodes(), fromScratch(mt, *criterion)) << m.name << " " << name;
        expectMet(mt, *criterion, cut.front());
      }
    EXPECT_TRUE(cut.validate()) << m.name;
  }
}

TEST(IncrementalCut, IsConformingWheneverTheClockStrikesAndGetsThereInTheEnd) {
  std::mt19937_64 random(10);
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    const DomainExtent domain = domainExtent(mt);
    for (int flight = 0; flight < 2; ++flight) {
      IncrementalCut cut(mt);
      const Extent extent(mt);
      const View before = randomView(extent, random), after = randomView(extent, random);
      ASSERT_TRUE(cut.update(ViewError({.view = before}, mt.arrays().metric)));
      const ViewError criterion({.view = after}, mt.arrays().metric);
      bool isComplete = false;
      for (int round = 0; round < 2000 && !isComplete; ++round) {
        const int looks = 4 + int(random() % 40);
        const auto update = cut.update(criterion, {.deadline = strikeAfter(looks)});
        ASSERT_TRUE(update);
        EXPECT_LE(update->refined + update->coarsened, std::uint32_t(looks)) << m.name;
        if (round < 20) {
          EXPECT_TRUE(cut.validate()) << m.name;
          EXPECT_TRUE(validateFront(mt, cut.front(), domain)) << m.name;
        }
        isComplete = update->isComplete;
      }
      EXPECT_TRUE(isComplete) << m.name;
      EXPECT_EQ(cut.nodes(), fromScratch(mt, criterion)) << m.name;
    }
  }
}

TEST(IncrementalCut, UnderABudgetThatShrinksAndGrowsEqualsTheCutFromScratch) {
  std::mt19937_64 random(11);
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    const std::uint32_t roots = mt.rootTriangleCount(), finest = mt.finestTriangleCount();
    const double span = mt.nodeCount() ? mt.largestError() : 1;
    {
      IncrementalCut cut(mt);
      const Extent extent(mt);
      for (int round = 0; round < 24; ++round) {
        const auto budget = roots + static_cast<std::uint32_t>(random() % (finest - roots + 1));
        std::shared_ptr<const Criterion> criterion = std::make_shared<UniformError>(0.001 * span);
        if (round % 2)
          criterion = std::make_shared<ViewError>(ViewError::Options{.view = randomView(extent, random)},
                                                  mt.arrays().metric);
        const auto update = cut.update(*criterion, {.maxTriangles = budget});
        ASSERT_TRUE(update);
        EXPECT_LE(cut.triangles().size(), budget) << m.name;
        EXPECT_TRUE(cut.validate()) << m.name;
        if (update->isComplete) expectMet(mt, *criterion, cut.front());
        const auto scratch =
            takeNodes(mt, *criterion, {.method = CutMethod::saturated, .maxTriangles = budget});
        EXPECT_EQ(cut.nodes(), scratch->nodes) << m.name << " round " << round;
        EXPECT_EQ(update->isComplete, scratch->isComplete) << m.name << " round " << round;
      }
    }
  }
}

TEST(IncrementalCut, KeepsAShrinkingBudgetEvenWhenTheTimeIsOver) {
  std::mt19937_64 random(12);
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    const std::uint32_t roots = mt.rootTriangleCount(), finest = mt.finestTriangleCount();
    IncrementalCut cut(mt);
    ASSERT_TRUE(cut.update(UniformError(0)));
    for (int share = 3; share >= 0; --share) {
      const std::uint32_t budget = roots + (finest - roots) * static_cast<std::uint32_t>(share) / 4;
      const auto update = cut.update(ViewError({.view = randomView(Extent(mt), random)}, mt.arrays().metric),
                                     {.maxTriangles = budget, .deadline = strikeAfter(0)});
      ASSERT_TRUE(update);
      EXPECT_LE(cut.triangles().size(), budget) << m.name;
      EXPECT_TRUE(cut.validate()) << m.name;
    }
    ASSERT_TRUE(cut.update(UniformError(0)));
    EXPECT_EQ(cut.nodes(), fromScratch(mt, UniformError(0))) << m.name;
  }
}

TEST(IncrementalCut, ReportsStepsThatAnotherCutCanApply) {
  std::mt19937_64 random(13);
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    IncrementalCut leader(mt), follower(mt);
    for (int round = 0; round < 6; ++round) {
      const ViewError criterion({.view = randomView(Extent(mt), random)}, mt.arrays().metric);
      ASSERT_TRUE(leader.update(criterion));
      ASSERT_TRUE(follower.apply(leader.lastSteps()));
      EXPECT_EQ(follower.nodes(), leader.nodes()) << m.name;
    }
    EXPECT_TRUE(follower.validate()) << m.name;
  }
}

TEST(IncrementalCut, RefusesAStepThatDoesNotFitAndNamesIt) {
  for (const FamilyModel& m : familyModels()) {
    if (m.model.mt.nodeCount() == 0) continue;
    IncrementalCut cut(m.model.mt);
    const CutStep undo{NodeId(0), false};
    const Status refused = cut.apply({&undo, 1});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().describe().find("node 0"), std::string::npos);
    EXPECT_TRUE(cut.validate());
  }
}

TEST(IncrementalCut, GivesTheSameStepsForAnyThreadCount) {
  const FamilyModel& m = familyModels().back();
  std::vector<std::vector<CutStep>> steps;
  for (const int threads : {1, 2, 4}) {
    std::mt19937_64 random(14);
    RunContext context;
    context.threads = threads;
    IncrementalCut cut(m.model.mt);
    std::vector<CutStep> all;
    for (int round = 0; round < 10; ++round) {
      const ViewError criterion({.view = randomView(Extent(m.model.mt), random)}, m.model.mt.arrays().metric);
      ASSERT_TRUE(cut.update(criterion, {}, context));
      all.insert(all.end(), cut.lastSteps().begin(), cut.lastSteps().end());
    }
    steps.push_back(all);
  }
  EXPECT_EQ(steps[0], steps[1]);
  EXPECT_EQ(steps[0], steps[2]);
}

}  // namespace
}  // namespace arete
