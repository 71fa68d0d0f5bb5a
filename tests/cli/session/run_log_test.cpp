// SPDX-License-Identifier: GPL-3.0-or-later
// The log of a run: what its lines say, and that they are there however the run ends.
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "cli/arguments_fixture.h"
#include "cli/session/sha256_of_file.h"

namespace arete::cli_test {
namespace {

class RunLogs : public Arguments {
 protected:
  std::vector<Json> lines(const std::string& name) const {
    std::vector<Json> found;
    std::istringstream stream(read(name));
    for (std::string line; std::getline(stream, line);) {
      found.push_back(Json::parse(line, nullptr, false));
      EXPECT_TRUE(found.back().is_object()) << line;
    }
    return found;
  }
  static std::vector<Json> of(const std::string& event, const std::vector<Json>& lines) {
    std::vector<Json> found;
    std::ranges::copy_if(lines, std::back_inserter(found),
                         [&](const Json& line) { return line["event"] == event; });
    return found;
  }
  /// "X,Y" of the first sample.
  std::string corner() const {
    const Json g = run({"info", "dem.amt", "--json"}).json()["grid"]["geoTransform"];
    return fmt::format("{},{}", g[0].get<double>() + g[1].get<double>() / 2,
                       g[3].get<double>() + g[5].get<double>() / 2);
  }
  std::string sha256(const std::string& name) const { return sha256OfFile(path(name)).value().sha256; }
};

TEST_F(RunLogs, SayWhatWasAskedForAndWhatCameOfIt) {
  const Outcome build = run({"build", "dem.tif", "-o", "new.amt", "--shape", "fidelity", "--no-features",
                             "--json", "--log", "run.jsonl"});
  ASSERT_EQ(build.code, 0) << build.err;
  const std::vector<Json> log = lines("run.jsonl");
  const Json& start = log.front();
  EXPECT_EQ(start["event"], "start");
  EXPECT_EQ("arete " + start["version"].get<std::string>() + "\n", run({"--version"}).out);
  EXPECT_EQ(start["command"], "build");
  EXPECT_EQ(start["arguments"].size(), 10u);
  EXPECT_EQ(start["options"]["shape"], "fidelity");
  EXPECT_EQ(start["options"]["no-features"], true);
  EXPECT_EQ(start["options"]["DEM"], "dem.tif");
  EXPECT_EQ(start["folder"], fs::canonical(folder_ / "here").string());
  EXPECT_GE(start["threads"].get<int>(), 1);
  EXPECT_GT(start["machine"]["memoryBytes"].get<double>(), 1e6);
  const std::string time = start["time"];
  EXPECT_EQ(time.size(), std::string("2026-01-31T12:00:00.123Z").size());
  EXPECT_TRUE(time.ends_with("Z"));
  ASSERT_EQ(start["inputs"].size(), 1u) << start;
  EXPECT_EQ(start["inputs"][0]["bytes"], fs::file_size(path("dem.tif")));

  const auto inputs = of("input", log), outputs = of("output", log), results = of("result", log);
  ASSERT_EQ(inputs.size(), 1u);
  EXPECT_EQ(inputs[0]["path"], "dem.tif");
  EXPECT_EQ(inputs[0]["sha256"], sha256("dem.tif"));
  ASSERT_EQ(outputs.size(), 1u);
  EXPECT_EQ(outputs[0]["path"], "new.amt");
  EXPECT_EQ(outputs[0]["sha256"], sha256("new.amt"));
  EXPECT_EQ(outputs[0]["bytes"], fs::file_size(path("new.amt")));
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0]["result"], build.json());
  EXPECT_EQ(log.back()["event"], "end");
  EXPECT_EQ(log.back()["exitCode"], 0);
  EXPECT_FALSE(log.back().contains("error"));
  for (const Json& line : log) EXPECT_EQ(line["run"], start["run"]);
}

TEST_F(RunLogs, HaveEveryStageWithItsTimeAndMemory) {
  ASSERT_EQ(run({"build", "dem.tif", "-o", "new.amt", "--log", "run.jsonl", "-q"}).code, 0);
  std::vector<std::string> begun, ended;
  double last = 0;
  for (const Json& line : lines("run.jsonl")) {
    EXPECT_GE(line["seconds"].get<double>(), last) << "lines stand in the order of their time";
    last = line["seconds"];
    if (line["event"] == "stage begins") begun.push_back(line["stage"]);
    if (line["event"] != "stage ends") continue;
    ended.push_back(line["stage"]);
    ASSERT_EQ(begun.size(), ended.size());
    EXPECT_EQ(begun.back(), ended.back()) << "one stage at a time";
    EXPECT_GE(line["stageSeconds"].get<double>(), 0);
    EXPECT_GE(line["stageCpuSeconds"].get<double>(), 0);
    EXPECT_GT(line["peakMemoryBytes"].get<double>(), 1e6);
  }
  EXPECT_EQ(begun, ended);
  for (const char* stage : {"reading", "triangulate", "simplify", "write"})
    EXPECT_EQ(std::ranges::count(begun, stage), 1) << stage;
}

TEST_F(RunLogs, AreTheSameAnswerAndTheSameTextWithAndWithoutJson) {
  const std::string at = middle();
  const std::string along = fmt::format("{}:{}", at, corner());
  const std::vector<std::vector<std::string>> commands = {
      {"info", "dem.amt"},
      {"height", "dem.amt", "--at", at},
      {"extract", "dem.amt", "-o", "x.ply", "--max-error", "2"},
      {"measure", "tin.ply", "dem.tif"},
      {"convert", "tin.ply", "-o", "x.obj"},
      {"mesh", "info", "tin.ply"},
      {"mesh", "repair", "tin.ply", "-o", "r.ply"},
      {"profile", "dem.amt", "--along", along},
      {"validate", "dem.amt", "--fronts", "1"}};
  for (std::vector<std::string> command : commands) {
    SCOPED_TRACE(command[0] + " " + command[1]);
    const Outcome text = run(command);
    for (const char* output : {"x.ply", "x.obj", "r.ply"}) std::filesystem::remove(path(output));
    command.insert(command.end(), {"--log", "text.jsonl"});
    const Outcome logged = run(command);
    EXPECT_EQ(logged.code, text.code) << logged.err;
    EXPECT_EQ(logged.out, text.out);
    EXPECT_EQ(logged.err, text.err);
    command.back() = "json.jsonl";
    command.push_back("--json");
    const Outcome json = run(command);
    const auto results = of("result", lines("text.jsonl")), others = of("result", lines("json.jsonl"));
    ASSERT_FALSE(results.empty());
    EXPECT_EQ(others.back()["result"], json.json());
    // Times differ from run to run.
    EXPECT_EQ(results.back()["result"].size(), json.json().size());
    EXPECT_EQ(lines("text.jsonl").back()["exitCode"], text.code);
  }
  const auto log = lines("text.jsonl");
  EXPECT_EQ(of("start", log).size(), commands.size()) << "runs are appended";
  EXPECT_EQ(of("end", log).size(), commands.size());
  EXPECT_EQ(of("start", log)[5]["command"], "mesh info");
}

TEST_F(RunLogs, KeepTheErrorOfARunThatFails) {
  for (const auto& [command, code] : std::vector<std::pair<std::vector<std::string>, int>>{
           {{"info", "nowhere.amt"}, 3},
           {{"info", "dem.tif"}, 3},
           {{"measure", "tin.ply", "dem.tif", "--expect", "0"}, 5},
           {{"extract", "dem.amt", "-o", "t.ply", "--max-error", "x"}, 2},
           {{"extract", "dem.amt", "-o", "t.ply", "--tolerance", "3"}, 2},
           {{"nonsense"}, 2}}) {
    SCOPED_TRACE(command[0] + (command.size() > 1 ? " " + command[1] : ""));
    fs::remove(path("run.jsonl"));
    std::vector<std::string> words = command;
    words.insert(words.end(), {"--log", "run.jsonl"});
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, run(command).code);
    const auto log = lines("run.jsonl");
    ASSERT_GE(log.size(), 2u) << outcome.err;
    EXPECT_EQ(log.front()["event"], "start");
    EXPECT_EQ(log.back()["event"], "end");
    EXPECT_EQ(log.back()["exitCode"], outcome.code);
    EXPECT_EQ(log.back()["error"]["exitCode"], outcome.code) << log.back();
    EXPECT_NE(log.back()["error"]["message"], "");
  }
}

TEST_F(RunLogs, HaveWarningsWithTheirCodesEvenWhenQuiet) {
  RasterHeightfield field;
  field.columns = field.rows = 5;
  for (int i = 0; i < 25; ++i) field.heights.push_back(i % 7);
  ASSERT_TRUE(writeGeoTiff(path("bare.tif"), 5, 5, field.heights, {}));  // no CRS
  ASSERT_EQ(run({"build", "bare.tif", "-o", "bare.amt", "-q", "--log", "run.jsonl"}).code, 0);
  const auto warnings = of("warning", lines("run.jsonl"));
  ASSERT_FALSE(warnings.empty());
  EXPECT_EQ(warnings[0]["code"], "position");
  EXPECT_NE(warnings[0]["message"].get<std::string>().find("bare.tif"), std::string::npos);
}

TEST_F(RunLogs, OfAKilledRunEndAtTheirStage) {
  makeRaster("large.tif", "noise", 1200, 1200);
  const auto whenItSimplifies = [&](int signal) {
    return [this, signal](pid_t child) {
      for (int i = 0; i < 60'000 && read("run.jsonl").find(R"("stage":"simplify")") == std::string::npos; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      kill(child, signal);
    };
  };
  const Outcome killed =
      run({"build", "large.tif", "-o", "x.amt", "-q", "--log", "run.jsonl"}, whenItSimplifies(SIGKILL));
  ASSERT_EQ(killed.code, 128 + SIGKILL);
  const auto log = lines("run.jsonl");
  EXPECT_EQ(of("stage begins", log).back()["stage"], "simplify");
  EXPECT_TRUE(of("end", log).empty());
  EXPECT_NE(of("stage ends", log).back()["stage"], "simplify");

  fs::remove(path("run.jsonl"));
  const Outcome interrupted =
      run({"build", "large.tif", "-o", "x.amt", "-q", "--log", "run.jsonl"}, whenItSimplifies(SIGINT));
  EXPECT_EQ(interrupted.code, 130);
  const Json end = lines("run.jsonl").back();
  EXPECT_EQ(end["event"], "end");
  EXPECT_EQ(end["exitCode"], 130);
  EXPECT_EQ(end["error"]["code"], "interrupted");
  EXPECT_FALSE(exists("x.amt"));
}

TEST_F(RunLogs, CloseALineThatAnEarlierRunWasCutIn) {
  write("run.jsonl", "{\"event\":\"start\",\"run\":\"1\"}\n{\"event\":\"stage beg");
  ASSERT_EQ(run({"info", "dem.amt", "-q", "--log", "run.jsonl"}).code, 0);
  const std::string text = read("run.jsonl");
  EXPECT_NE(text.find("stage beg\n{\"event\":\"start\""), std::string::npos) << text;
}

TEST_F(RunLogs, OfSeveralProcessesDoNotMix) {
  const std::string command =
      fmt::format("cd '{}' && for i in 1 2 3 4 5 6; do '{}' info dem.amt -q --log all.jsonl & done; wait",
                  (folder_ / "here").string(), ARETE_PROGRAM);
  ASSERT_EQ(std::system(command.c_str()), 0);
  const auto log = lines("all.jsonl");
  EXPECT_EQ(of("start", log).size(), 6u);
  EXPECT_EQ(of("end", log).size(), 6u);
  std::set<std::string> runs;
  for (const Json& line : log) runs.insert(line["run"].get<std::string>());
  EXPECT_EQ(runs.size(), 6u);
}

TEST_F(RunLogs, AreNeverAppendedToAnotherFile) {
  fs::create_symlink("dem.tif", path("link.jsonl"));
  write("notes.txt", "my notes\n");
  const std::set<std::string> before = files();
  for (const char* name : {"dem.tif", "./dem.tif", "link.jsonl", "x.amt", "./x.amt", "notes.txt", "tin.ply",
                           "-", "nowhere/run.jsonl", "."}) {
    SCOPED_TRACE(name);
    const std::string dem = read("dem.tif");
    const Outcome outcome = run({"build", "dem.tif", "-o", "x.amt", "-q", "--log", name});
    EXPECT_TRUE(outcome.code == 2 || outcome.code == 3) << outcome.code;
    EXPECT_NE(outcome.err.find("--log"), std::string::npos) << outcome.err;
    EXPECT_EQ(files(), before);
    EXPECT_TRUE(read("dem.tif") == dem);
    EXPECT_EQ(read("notes.txt"), "my notes\n");
  }
}

TEST_F(RunLogs, ThatCannotBeWrittenAreAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  const Outcome outcome = run({"info", "dem.amt", "-q", "--log", "/dev/full"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("/dev/full: the log cannot be written"), std::string::npos) << outcome.err;
}

TEST_F(RunLogs, AreWrittenWhereTheRunIsConfinedAndSeveralFilesAreInputs) {
  fs::create_directory(path("tiles"));
  fs::copy(path("dem.tif"), path("tiles/a.tif"));
  const Outcome outcome =
      run({"build", "tiles/a.tif", "-o", "x.amt", "-q", "--confined", "--log", "run.jsonl"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  ASSERT_EQ(run({"build", "tiles", "-o", "x.amt", "-q", "--log", "run.jsonl"}).code, 0);
  const auto inputs = of("input", lines("run.jsonl"));
  ASSERT_EQ(inputs.size(), 2u);
  EXPECT_EQ(inputs[1]["path"], "tiles/a.tif");
  EXPECT_EQ(inputs[1]["sha256"], sha256("dem.tif"));
}

TEST_F(RunLogs, HoldNoSecretsOfAddresses) {
  run({"build", "http://127.0.0.1:9/dem.tif?token=abc", "-o", "x.amt", "-q", "--log", "run.jsonl"});
  EXPECT_EQ(read("run.jsonl").find("token=abc"), std::string::npos) << read("run.jsonl");
}

}  // namespace
}  // namespace arete::cli_test
