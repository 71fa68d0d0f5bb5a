// SPDX-License-Identifier: GPL-3.0-or-later
// The time left, with a clock of the test's own.
#include "cli/session/time_left.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

#include "cli/session/progress_bar.h"

namespace arete {
namespace {

constexpr PlannedStage kPlan[] = {{"read", 10}, {"work", 80}, {"write", 10}};

struct Stage {
  const char* name;
  double seconds;
  std::function<double(double)> timeAt = [](double f) { return f; };  ///< share of its time at a fraction
};

/// Runs stages of a plan; calls `check` with the estimate and the truth after every hundredth.
void play(
    const std::vector<Stage>& stages,
    const std::function<void(const std::string&, double fraction, std::optional<double>, double)>& check) {
  TimeLeft left;
  left.setPlan(kPlan);
  double all = 0, begin = 0;
  for (const Stage& stage : stages) all += stage.seconds;
  for (const Stage& stage : stages) {
    for (int i = 0; i <= 100; ++i) {
      const double now = begin + stage.seconds * stage.timeAt(i / 100.0);
      left.report(stage.name, i / 100.0, now);
      check(stage.name, i / 100.0, left.seconds(), all - now);
    }
    begin += stage.seconds;
  }
}

TEST(TimeLeft, IsKnownOfStagesThatTakeTheirWeights) {
  int estimates = 0;
  play({{"read", 20}, {"work", 160}, {"write", 20}},
       [&](const std::string& stage, double fraction, std::optional<double> left, double truth) {
         if (!left) return;
         ++estimates;
         EXPECT_NEAR(*left, truth, 0.05 * truth + 1) << stage << " " << fraction;
       });
  EXPECT_GT(estimates, 250);
}

TEST(TimeLeft, IsRightWithinAFactorWhereWeightsAreWrong) {
  // The last stage takes four times its share.
  play({{"read", 20}, {"work", 160}, {"write", 80}},
       [&](const std::string& stage, double fraction, std::optional<double> left, double truth) {
         if (!left || truth < 10) return;
         EXPECT_LT(std::abs(std::log(*left / truth)), std::log(4.5)) << stage << " " << fraction;
         if (stage == "write") {
           EXPECT_NEAR(*left, truth, 2) << "of its own stage it knows the speed";
         }
       });
}

TEST(TimeLeft, FollowsAStageThatBecomesSlower) {
  play({{"read", 5}, {"work", 400, [](double f) { return f * f; }}, {"write", 50}},
       [&](const std::string& stage, double fraction, std::optional<double> left, double truth) {
         if (!left || stage != "work" || fraction < 0.45) return;
         EXPECT_LT(std::abs(std::log(*left / truth)), std::log(2.0)) << fraction;
       });
}

TEST(TimeLeft, IsNeverAFewSecondsWhereMinutesAreLeft) {
  for (const double power : {0.5, 1.0, 2.0})
    play({{"read", 2}, {"work", 600, [=](double f) { return std::pow(f, power); }}, {"write", 100}},
         [&](const std::string& stage, double fraction, std::optional<double> left, double truth) {
           if (left && truth > 120) {
             EXPECT_GT(*left, 30) << stage << " " << fraction << ", power " << power;
           }
         });
}

TEST(TimeLeft, IsUnknownInTheFirstSecondsAndOfAJump) {
  TimeLeft left;
  left.report("work", 0, 0);
  left.report("work", 0.5, 1);
  EXPECT_FALSE(left.seconds());
  left.report("work", 0.6, 4);
  left.report("work", 0.61, 400);
  EXPECT_FALSE(left.seconds()) << "two estimates that differ";
  EXPECT_FALSE(left.isOfCommand());
}

TEST(TimeLeft, HasNoMoreDigitsThanAnEstimate) {
  EXPECT_EQ(TimeLeft::textOf(0.2), "5 s");
  EXPECT_EQ(TimeLeft::textOf(41), "40 s");
  EXPECT_EQ(TimeLeft::textOf(58), "1 min");
  EXPECT_EQ(TimeLeft::textOf(200), "3 min");
  EXPECT_EQ(TimeLeft::textOf(3590), "1 h 0 min");
  EXPECT_EQ(TimeLeft::textOf(4800), "1 h 20 min");
}

/// What a bar writes of a stage that takes so many seconds.
std::string lineOf(double seconds, std::span<const PlannedStage> plan) {
  std::FILE* const file = std::tmpfile();
  double now = 1000;
  {
    ProgressBar bar(file, [&] { return now; });
    bar.setPlan(plan);
    for (int i = 0; i <= 400; ++i) {
      now = 1000 + seconds * i / 400;
      bar.report("work", i / 400.0);
    }
  }
  std::string text(static_cast<std::size_t>(std::ftell(file)), ' ');
  std::rewind(file);
  EXPECT_EQ(std::fread(text.data(), 1, text.size(), file), text.size());
  std::fclose(file);
  return text;
}

TEST(TimeLeft, IsPartOfALineOfLongWorkAlone) {
  EXPECT_EQ(lineOf(4, {}), "work 0...10...20...30...40...50...60...70...80...90...100 - done.\n");
  const std::string alone = lineOf(40, {});
  EXPECT_EQ(alone.find("work 0...10 (35 s left of this stage)...20 (30 s left of this stage)...30"), 0u)
      << alone;
  EXPECT_TRUE(alone.ends_with("80 (10 s left of this stage)...90...100 - done.\n")) << alone;
  const std::string planned = lineOf(400, kPlan);
  EXPECT_NE(planned.find("50 (4 min left)..."), std::string::npos) << planned;
  EXPECT_NE(planned.find("90 (2 min left)..."), std::string::npos) << planned;
}

}  // namespace
}  // namespace arete
