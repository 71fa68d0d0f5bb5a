// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/tools/command_job.h"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <thread>

namespace arete {
namespace {

std::optional<Result<std::string>> ended(CommandJob& job) {
  for (int i = 0; i < 2000 && job.isRunning(); ++i) {
    if (auto done = job.take()) return done;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return std::nullopt;
}

TEST(CommandJob, RunsCommandsInTheirOrderAndHandsOnWhatTheLastOneSays) {
  CommandJob job;
  job.start("/bin/echo", {{"one"}, {"two words"}});
  const auto done = ended(job);
  ASSERT_TRUE(done && *done) << (done ? done->error().describe() : "it hangs");
  EXPECT_EQ(**done, "two words --progress\n");
  EXPECT_FALSE(job.isRunning());
}

TEST(CommandJob, SaysWhyACommandFailsAndDoesNotBeginTheNext) {
  CommandJob job;
  job.start("/bin/sh",
            {{"-c", "echo 'arete: scan.obj: has no faces' >&2; echo 'see arete --help' >&2; exit 3"},
             {"-c", "echo never"}});
  const auto done = ended(job);
  ASSERT_TRUE(done && !*done);
  EXPECT_EQ(done->error().message, "scan.obj: has no faces");
  job.start("/nowhere/arete", {{"build"}});
  const auto absent = ended(job);
  ASSERT_TRUE(absent && !*absent);
  EXPECT_EQ(absent->error().culprit, "/nowhere/arete");
}

TEST(CommandJob, ACommandThatIsStoppedIsInterrupted) {
  CommandJob job;
  job.start("/bin/sh", {{"-c", "sleep 60"}});
  const auto begun = std::chrono::steady_clock::now();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  job.cancel();
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(5));
  EXPECT_FALSE(job.isRunning());
}

TEST(CommandJob, WordsAreQuotedAsAShellTakesThem) {
  EXPECT_EQ(textOf({"mesh", "crop", "my scan.obj", "--box=0,0,0,1,1,1"}),
            "arete mesh crop 'my scan.obj' --box=0,0,0,1,1,1");
}

}  // namespace
}  // namespace arete
