// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C leaves no half-made file.
#include "cli/cli_fixture.h"

namespace arete::cli_test {
namespace {

class Interrupt : public Cli {
 protected:
  /// Sends the signal once stderr shows the stage (or the program has ended).
  auto when(const std::string& stage, int signal) const {
    return [this, stage, signal](pid_t child) {
      for (int i = 0; i < 60'000; ++i) {
        if (errSoFar().find(stage) != std::string::npos) break;
        siginfo_t ended{};
        if (waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
            ended.si_pid == child)
          return;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      kill(child, signal);
    };
  }
};

TEST_F(Interrupt, LeavesNoFileOfABuild) {
  makeRaster("dem.tif", "noise", 1000, 1000);
  for (const auto& [stage, signal] : {std::pair{"simplify ", SIGINT}, {"triangulate ", SIGTERM}}) {
    SCOPED_TRACE(stage);
    const Outcome outcome = run({"build", "dem.tif", "-o", "dem.amt", "--progress"}, when(stage, signal));
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
    EXPECT_EQ(files(), (std::set<std::string>{"dem.tif"}));
  }
}

TEST_F(Interrupt, LeavesAnOlderFileAsItWas) {
  makeRaster("dem.tif", "noise", 1000, 1000);
  write("dem.amt", "something older");
  const Outcome outcome = run({"build", "dem.tif", "-o", "dem.amt", "--progress"}, when("simplify ", SIGINT));
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_EQ(read("dem.amt"), "something older");
  EXPECT_EQ(files(), (std::set<std::string>{"dem.amt", "dem.tif"}));
}

TEST_F(Interrupt, StopsReadingAndRankingToo) {
  makeRaster("dem.tif", "noise", 2000, 2000);
  for (const char* stage : {"reading ", "ranking"}) {
    SCOPED_TRACE(stage);
    const Outcome outcome =
        run({"build", "dem.tif", "-o", "dem.amt", "--progress", "--json"}, when(stage, SIGINT));
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_EQ(outcome.json()["error"]["code"], "interrupted");
    EXPECT_EQ(files(), (std::set<std::string>{"dem.tif"}));
  }
}

TEST_F(Interrupt, StopsAViewshedWhileItFindsWhatIsInRangeOfManyObservers) {
  makeRaster("dem.tif", "noise", 300, 300);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  std::string observers = "x,y,h,range\n";
  for (int i = 0; i < 20'000; ++i)
    observers += std::to_string(i % 300) + "," + std::to_string(i / 300) + ",10,5\n";
  write("observers.csv", observers);
  const Outcome outcome = run({"viewshed", "dem.amt", "--observers", "observers.csv", "--mode", "count", "-o",
                               "count.tif", "--progress"},
                              when("find what is in range ", SIGINT));
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_EQ(files(), (std::set<std::string>{"dem.amt", "dem.tif", "observers.csv"}));
}

}  // namespace
}  // namespace arete::cli_test
