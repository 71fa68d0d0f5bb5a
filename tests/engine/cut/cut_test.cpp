// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every cut promises, whatever its method; its refusals and its cancellation.
#include "engine/cut/cut.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "engine/cut_promises.h"
#include "engine/family_models.h"

namespace arete {
namespace {

TEST(Cuts, AreConformingAndMeetEveryCriterion) {
  std::mt19937_64 random(7);
  for (const FamilyModel& s : familyModels())
    for (const auto& [name, criterion] : criteriaFor(s.model.mt, random)) {
      SCOPED_TRACE(s.name + " " + name);
      expectCutsKept(s.model.mt, *criterion);
    }
}

TEST(MinimalCut, TakesAnyPredicateAndSaturatedRefusesIt) {
  struct Odd final : Criterion {
    bool isFineEnough(const MultiTriangulation&, TriangleId t,
                      const std::array<std::uint32_t, 3>&) const override {
      return t.index() % 3 != 0;
    }
  };
  for (const FamilyModel& s : familyModels()) {
    const auto nodes = takeNodes(s.model.mt, Odd{});
    ASSERT_TRUE(nodes);
    EXPECT_EQ(nodes->nodes, leastClosedSet(s.model.mt, Odd{})) << s.name;
    const auto refused = takeCut(s.model.mt, Odd{}, {.method = CutMethod::saturated});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::usage);
  }
}

TEST(Budget, BelowTheRootIsRefusedWithTheCount) {
  const FamilyModel& s = familyModels().front();
  for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
    const auto cut = takeCut(s.model.mt, UniformError(0),
                             {.method = method, .maxTriangles = s.model.mt.rootTriangleCount() - 1});
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().code, ErrorCode::usage);
    EXPECT_NE(cut.error().message.find(std::to_string(s.model.mt.rootTriangleCount())), std::string::npos);
  }
}

TEST(Cuts, StopWhenAskedTo) {
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
    const auto cut = takeCut(familyModels().front().model.mt, UniformError(0), {.method = method}, context);
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().code, ErrorCode::interrupted);
  }
}

}  // namespace
}  // namespace arete
