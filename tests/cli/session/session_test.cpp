// SPDX-License-Identifier: GPL-3.0-or-later
// What every command has: help, JSON, quiet, progress, a full disk.
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "cli/arguments_fixture.h"

namespace arete::cli_test {
namespace {

using Sessions = Arguments;

TEST_F(Sessions, HelpAndVersionAreAnswers) {
  const Outcome help = run({"--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* text :
       {"build", "info", "extract", "height", "measure", "validate", "Exit codes", "130", "Examples"})
    EXPECT_NE(help.out.find(text), std::string::npos) << text;
  for (const char* command : {"build", "info", "extract", "height", "measure", "validate"}) {
    const Outcome own = run({command, "--help"});
    EXPECT_EQ(own.code, 0);
    EXPECT_NE(own.out.find(std::string("  arete ") + command), std::string::npos) << own.out;
    for (const char* option : {"--json", "--quiet", "--progress"})
      EXPECT_NE(own.out.find(option), std::string::npos) << option;
  }
  EXPECT_EQ(run({"--version"}).out.rfind("arete ", 0), 0u);
  EXPECT_EQ(run({}).code, 2);
  // The words of git and of gdal.
  EXPECT_EQ(run({"version"}).out, run({"--version"}).out);
  EXPECT_EQ(run({"help"}).out, help.out);
  EXPECT_EQ(run({"help", "build"}).out, run({"build", "--help"}).out);
  EXPECT_EQ(run({"help", "mesh", "info"}).out, run({"mesh", "info", "--help"}).out);
  expectRefusal({"help", "biuld"}, 2, "no command 'biuld'");
}

TEST_F(Sessions, WritesNoFileNamedAsStdout) {
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"build", "dem.tif", "-o", "-"},
           {"viewshed", "dem.amt", "--observer", "1,1,2", "-o", "-"},
           {"height", "dem.amt", "--points", "p.csv", "-o", "-"},
           {"extract", "dem.amt", "--max-error", "1", "-o", "x.ply", "--certificate", "-"}}) {
    SCOPED_TRACE(command.front());
    const std::set<std::string> before = files();
    EXPECT_EQ(run(command).code, 2);
    EXPECT_EQ(files(), before);
  }
  expectRefusal({"build", "dem.tif", "-o", "-"}, 2, "--output -: this output cannot go to stdout");
}

TEST_F(Sessions, NamesTheCommandsItHas) {
  expectRefusal({"biuld"}, 2, "no command 'biuld'; the commands are build, info");
  expectRefusal({"build"}, 2, "DEM is required");
  expectRefusal({"build", "dem.tif"}, 2, "--output is required");
  expectRefusal({"build", "dem.tif", "-o", "x.amt", "--foo"}, 2, "--foo");
}

TEST_F(Sessions, QuietSaysNothingAndJsonOneObject) {
  const std::vector<std::vector<std::string>> commands = {
      {"build", "dem.tif", "-o", "x.amt"},
      {"info", "dem.amt"},
      {"extract", "dem.amt", "-o", "x.ply", "--max-error", "2"},
      {"measure", "tin.ply", "dem.tif"},
      {"validate", "dem.amt", "--fronts", "1"}};
  for (std::vector<std::string> command : commands) {
    SCOPED_TRACE(command.front());
    command.push_back("--quiet");
    const Outcome quiet = run(command);
    EXPECT_EQ(quiet.code, 0);
    EXPECT_EQ(quiet.out + quiet.err, "");
    command.back() = "--json";
    const Outcome json = run(command);
    EXPECT_EQ(json.code, 0);
    EXPECT_TRUE(json.json().is_object()) << json.out;
    EXPECT_EQ(json.err, "");
  }
  const Outcome error = run({"info", "nowhere.amt", "--json", "--quiet"});
  EXPECT_EQ(error.code, 3);
  EXPECT_EQ(error.json()["error"]["exitCode"], 3);
  EXPECT_NE(error.err, "");
}

TEST_F(Sessions, ProgressIsGdalsWhenAskedFor) {
  const Outcome outcome = run({"build", "dem.tif", "-o", "x.amt", "--progress"});
  ASSERT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find(" 0...10...20...30...40...50...60...70...80...90...100 - done.\n"),
            std::string::npos)
      << outcome.err;
  EXPECT_EQ(outcome.out.find("..."), std::string::npos);
}

TEST_F(Sessions, TellsAStdoutThatIsFull) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  const std::string command =
      std::string("'" ARETE_PROGRAM "' info '") + path("dem.amt") + "' >/dev/full 2>/dev/null";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 3);
}

TEST_F(Sessions, SpeakJsonEvenWhenTheyCannotBeParsed) {
  expectErrorObject(run({"extract", "dem.amt", "-o", "t.ply", "--max-error", "x", "--json"}), 2);
  expectErrorObject(run({"extract", "--json"}), 2);
  expectErrorObject(run({"nonsense", "--json"}), 2);
}

TEST_F(Sessions, TakeAnyNumberOfThreadsFromOneTo4096) {
  for (const char* threads : {"1", "3", "4096"})
    EXPECT_EQ(run({"info", "dem.amt", "-q", "--threads", threads}).code, 0) << threads;
  for (const char* threads : {"0", "-1", "4097", "x", "nan", "1.5"}) {
    const Outcome refused = run({"info", "dem.amt", "-q", "--threads", threads});
    EXPECT_EQ(refused.code, 2) << threads;
    EXPECT_NE(refused.err.find("--threads"), std::string::npos) << refused.err;
  }
}

}  // namespace
}  // namespace arete::cli_test
