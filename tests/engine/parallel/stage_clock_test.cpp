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

TEST(StageClock, IsOptional) {
  const StageClock::Scope scope(nullptr, "no clock");
}

}  // namespace
}  // namespace arete
