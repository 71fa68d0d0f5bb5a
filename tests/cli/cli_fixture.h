// SPDX-License-Identifier: GPL-3.0-or-later
//
// arete as a user meets it: a folder of the test's own, arguments in, files, text and exit codes out.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "datasets/families.h"
#include "io/geo/dem/raster_writer.h"

namespace arete::cli_test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct Outcome {
  int code = -1;  ///< exit code; 128 + signal when a signal ended it
  std::string out, err;
  Json json() const { return Json::parse(out, nullptr, false); }
};

class Cli : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "arete-cli-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    fs::create_directory(folder_ / "here");
  }
  void TearDown() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  std::string path(const std::string& name) const { return (folder_ / "here" / name).string(); }
  bool exists(const std::string& name) const { return fs::exists(path(name)); }
  std::string read(const std::string& name) const { return contentOf(path(name)); }
  Json readJson(const std::string& name) const { return Json::parse(read(name), nullptr, false); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }
  /// What is in the folder, hidden files too.
  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / "here"))
      names.insert(entry.path().filename().string());
    return names;
  }

  /// For `meanwhile` of run(): waits for the process, and kills it after about twenty seconds.
  static void killIfItHangs(pid_t child) {
    for (int i = 0; i < 20'000; ++i) {
      siginfo_t ended{};
      if (waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
          ended.si_pid == child)
        return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    kill(child, SIGKILL);
  }

  /// Runs arete in the folder. `meanwhile` is called with its process id while it runs.
  Outcome run(const std::vector<std::string>& arguments,
              const std::function<void(pid_t)>& meanwhile = {}) const {
    const std::string out = (folder_ / "out").string(), err = (folder_ / "err").string();
    fs::remove(out);  // what an earlier run said is not what this one has said so far
    fs::remove(err);
    const pid_t child = fork();
    if (child == 0) {
      redirect(out, STDOUT_FILENO);
      redirect(err, STDERR_FILENO);
      redirect("/dev/null", STDIN_FILENO);
      if (chdir((folder_ / "here").c_str()) != 0) _exit(99);
      std::vector<char*> argv = {const_cast<char*>("arete")};
      for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
      argv.push_back(nullptr);
      execv(ARETE_PROGRAM, argv.data());
      _exit(98);
    }
    if (meanwhile) meanwhile(child);
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), contentOf(out), contentOf(err)};
  }

  /// What arete, still running, has said on stderr.
  std::string errSoFar() const { return contentOf((folder_ / "err").string()); }

  /// A raster of one of the families as a GeoTIFF of doubles.
  void makeRaster(const std::string& name, std::string_view family, std::uint32_t columns,
                  std::uint32_t rows) const {
    for (const auto families : {rasterFamilies(), degenerateFamilies()})
      for (const RasterFamily& candidate : families)
        if (candidate.name == family) {
          const RasterHeightfield field = candidate.make(columns, rows, 1);
          GeoTiffOptions options;
          options.sample = GeoTiffOptions::Sample::float64;
          const Status written =
              writeGeoTiff(path(name), field.columns, field.rows, field.heights, field.georeference, options);
          ASSERT_TRUE(written) << written.error().describe();
          return;
        }
    FAIL() << "there is no family " << family;
  }

  fs::path folder_;

 private:
  static std::string contentOf(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static void redirect(const std::string& file, int descriptor) {
    const int opened =
        open(file.c_str(), descriptor == STDIN_FILENO ? O_RDONLY : O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (opened < 0 || dup2(opened, descriptor) < 0) _exit(97);
    close(opened);
  }
};

/// The path of a file of the real data ($ARETE_DATA, or shared/data beside the repository); empty if nowhere.
inline std::string realData(const std::string& name) {
  const char* stated = std::getenv("ARETE_DATA");
  const fs::path repository = fs::path(__FILE__).parent_path().parent_path().parent_path();
  const fs::path file = (stated ? fs::path(stated) : repository.parent_path() / "shared" / "data") / name;
  return fs::exists(file) ? fs::absolute(file).string() : std::string();
}

}  // namespace arete::cli_test
