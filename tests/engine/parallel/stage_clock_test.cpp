// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/parallel/stage_clock.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace arete {
namespace {

void pass(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

TEST(StageClock, ListsStagesInTheOrderOfFirstEnteringAndCountsHowOftenEachWasEntered) {
  StageClock clock;
  for (int level = 0; level < 3; ++level) {
    { const StageClock::Scope scope(&clock, "evaluate"); }
    { const StageClock::Scope scope(&clock, "choose"); }
  }
  ASSERT_EQ(clock.times().size(), 2u);
  EXPECT_EQ(clock.times()[0].stage, "evaluate");
  EXPECT_EQ(clock.times()[0].times, 3u);
  EXPECT_EQ(clock.times()[1].stage, "choose");
  EXPECT_EQ(clock.times()[1].times, 3u);
}

TEST(StageClock, CreditsTheInnerStageAloneAndAddsUpToTheWhole) {
  const auto start = std::chrono::steady_clock::now();
  StageClock clock;
  {
    const StageClock::Scope outer(&clock, "outer");
    pass(2);
    {
      const StageClock::Scope inner(&clock, "inner");
      pass(20);
    }
    pass(2);
  }
  const double whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ASSERT_EQ(clock.times().size(), 2u);
  // Sleeping takes at least what it was asked for; how much more does not matter here.
  EXPECT_GE(clock.times()[0].seconds, 0.004);
  EXPECT_GE(clock.times()[1].seconds, 0.020);
  EXPECT_LE(clock.times()[0].seconds + clock.times()[1].seconds, whole);
}

TEST(StageClock, DoesNotRunBetweenScopes) {
  const auto start = std::chrono::steady_clock::now();
  StageClock clock;
  { const StageClock::Scope scope(&clock, "a"); }
  pass(20);
  { const StageClock::Scope scope(&clock, "a"); }
  const double whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_LE(clock.times()[0].seconds, whole - 0.020);
}

TEST(StageClock, SharesWhatHasPassedAmongTheStagesThatWorkersTellOf) {
  StageClock clock, one, other;
  {
    const StageClock::Scope outer(&clock, "outer");
    {
      const StageClock::Scope scope(&one, "evaluate");
      pass(6);
    }
    {
      const StageClock::Scope scope(&other, "evaluate");
      pass(6);
    }
    {
      const StageClock::Scope scope(&other, "remove");
      pass(4);
    }
    const double evaluating = one.times()[0].seconds + other.times()[0].seconds,
                 removing = other.times()[1].seconds;
    StageClock* const workers[] = {&one, &other};
    clock.shareOut(workers);
    ASSERT_EQ(clock.times().size(), 3u);
    EXPECT_EQ(clock.times()[1].stage, "evaluate");
    EXPECT_EQ(clock.times()[1].times, 2u);
    EXPECT_NEAR(clock.times()[1].seconds / clock.times()[2].seconds, evaluating / removing, 1e-9);
    EXPECT_GE(clock.times()[1].seconds + clock.times()[2].seconds, 0.016);
    EXPECT_TRUE(one.times().empty() && other.times().empty());
    clock.shareOut(workers);  // of which nobody has done anything
  }
  EXPECT_LE(clock.times()[0].seconds, 0.010) << "what was shared out is no longer the outer stage's";
}

TEST(StageClock, MovesAShareOfAStageToAnotherAndLosesNothing) {
  StageClock clock;
  for (int i = 0; i < 2; ++i) {
    const StageClock::Scope scope(&clock, "remove");
    pass(4);
  }
  const StageTime whole = clock.times()[0];
  clock.moveShare("remove", "bounds", 0.25);
  ASSERT_EQ(clock.times().size(), 2u);
  const StageTime &left = clock.times()[0], &moved = clock.times()[1];
  EXPECT_EQ(moved.stage, "bounds");
  EXPECT_EQ(moved.times, 2u);
  EXPECT_NEAR(moved.seconds, 0.25 * whole.seconds, 1e-12);
  EXPECT_NEAR(left.seconds + moved.seconds, whole.seconds, 1e-12);
  EXPECT_NEAR(left.cpuSeconds + moved.cpuSeconds, whole.cpuSeconds, 1e-12);
}

TEST(StageClock, IsOptional) {
  const StageClock::Scope scope(nullptr, "nobody listens");
}

}  // namespace
}  // namespace arete
