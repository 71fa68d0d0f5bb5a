// SPDX-License-Identifier: GPL-3.0-or-later
// What happens around a run: descriptors that are closed, limits, kills, files that change under it, pipes.
#include <sys/stat.h>

#include <thread>

#include "cli/arguments_fixture.h"

namespace arete::cli_test {
namespace {

class Faults : public Arguments {
 protected:
  /// The exit code of a line of the shell, in the folder; "arete" is the program.
  int shell(const std::string& line) const {
    const std::string all = "cd '" + path("") + "' && arete() { '" ARETE_PROGRAM "' \"$@\"; }; " + line;
    const int status = std::system(("bash -c '" + escaped(all) + "'").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  static std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result;
  }
};

TEST_F(Faults, KeepTheExitCodeWithClosedDescriptors) {
  EXPECT_EQ(shell("arete info dem.amt >/dev/null 2>&-"), 0);
  EXPECT_EQ(shell("arete info nowhere.amt >/dev/null 2>&-"), 3);
  EXPECT_EQ(shell("arete info dem.amt --foo >/dev/null 2>&-"), 2);
  EXPECT_EQ(shell("arete >/dev/null 2>&-"), 2);
  EXPECT_EQ(shell("arete build dem.tif -o b.amt --progress >/dev/null 2>&-"), 0);
  EXPECT_EQ(shell("arete info dem.amt >&- 2>/dev/null"), 3) << "stdout is closed: the answer is lost";
  EXPECT_EQ(shell("arete extract dem.amt -o c.ply --max-error 5 -q >&- 2>&- <&-"), 0);
  EXPECT_EQ(run({"measure", "c.ply", "dem.tif", "--expect", "5"}).code, 0)
      << "nothing was written into the file";
}

TEST_F(Faults, EndWithASentenceAtTheLimitOfFileSizes) {
  for (const char* command :
       {"build dem.tif -o x.amt", "extract dem.amt -o x.ply --max-error 0",
        "extract dem.amt -o x.gpkg --max-error 0", "extract dem.amt -o x.tif --max-error 0"})
    EXPECT_EQ(shell(std::string("ulimit -f 1; arete ") + command + " >/dev/null 2>&1"), 3) << command;
  EXPECT_EQ(files(), before_);
}

TEST_F(Faults, LeaveNothingForLongWhenKilled) {
  makeRaster("big.tif", "noise", 700, 700);
  run({"build", "big.tif", "-o", "big.amt"}, [this](pid_t child) {
    for (int i = 0; i < 30'000; ++i) {
      for (const std::string& name : files())
        if (name.front() == '.') i = 30'000;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    kill(child, SIGKILL);
  });
  fs::remove(path("big.tif"));
  fs::remove(path("big.amt"));  // where the run was faster
  EXPECT_EQ(run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", "5"}).code, 0);
  EXPECT_EQ(files(), before_);
}

TEST_F(Faults, AreNoAnswerFromAFileThatChanges) {
  makeRaster("big.tif", "noise", 600, 600);
  ASSERT_EQ(run({"build", "big.tif", "-o", "big.amt", "-q"}).code, 0);
  const auto whole = fs::file_size(path("big.amt"));
  for (const bool isTruncated : {true, false}) {
    fs::copy_file(path("big.amt"), path("model.amt"), fs::copy_options::overwrite_existing);
    const Outcome outcome = run({"validate", "model.amt", "--progress"}, [&](pid_t) {
      for (int i = 0; i < 30'000 && errSoFar().empty(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (isTruncated) {
        fs::resize_file(path("model.amt"), 4096);
        return;
      }
      std::fstream file(path("model.amt"), std::ios::binary | std::ios::in | std::ios::out);
      file.seekp(std::streamoff(whole / 3));
      file << std::string(whole / 2, '\x5a');
    });
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_NE(outcome.err.find("model.amt: was changed while it was read"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "") << "no answer";
  }
}

TEST_F(Faults, AreNotWaitingForAPipe) {
  for (const char* name : {"pipe", "pipe.tif", "pipe.gpkg", "pipe.csv", "pipe.amt"}) {
    ASSERT_EQ(mkfifo(path(name).c_str(), 0600), 0);
    const std::string pipe = name;
    for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
             {"build", pipe, "-o", "x.amt"},
             {"info", pipe},
             {"measure", pipe, "dem.tif"},
             {"measure", "tin.ply", pipe},
             {"convert", pipe, "-o", "x.ply"},
             {"height", "dem.amt", "--points", pipe},
             {"los", "dem.amt", "--pairs", pipe},
             {"profile", "dem.amt", "--along", pipe},
             {"viewshed", "dem.amt", "--observers", pipe, "-o", "x.tif"},
             {"extract", "dem.amt", "-o", "x.ply", "--max-error", "1", "--region", pipe}}) {
      SCOPED_TRACE(command[0] + " " + pipe);
      const Outcome outcome = run(command, killIfItHangs);
      EXPECT_TRUE(outcome.code == 3 || outcome.code == 2) << outcome.code << outcome.err;
    }
  }
}

TEST_F(Faults, EndWithTheFirstSignalWhereALibraryWaits) {
  // GDAL opens the sidecar, which is a pipe.
  ASSERT_EQ(mkfifo(path("dem.tif.aux.xml").c_str(), 0600), 0);
  const Outcome outcome = run({"build", "dem.tif", "-o", "x.amt"}, [](pid_t child) {
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    kill(child, SIGINT);
  });
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_FALSE(exists("x.amt"));
}

TEST_F(Faults, AreNoReasonToTellWhereSomebodyKeepsADem) {
  ASSERT_EQ(run({"build", path("dem.tif"), "-o", "far.amt", "-q"}).code, 0);
  ASSERT_EQ(run({"extract", "far.amt", "-o", "far.ply", "--max-error", "5", "-q"}).code, 0);
  EXPECT_NE(read("far.ply").find("TIN of dem.tif ("), std::string::npos);
  EXPECT_EQ(read("far.ply").find(folder_.string()), std::string::npos);
}

}  // namespace
}  // namespace arete::cli_test
