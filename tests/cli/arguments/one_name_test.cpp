// SPDX-License-Identifier: GPL-3.0-or-later
// One name for one thing: what GDAL's driver and Python take is called as the command's option.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cli/commands/program.h"
#include "cli/session/session.h"

namespace arete::cli_test {
namespace {

const std::filesystem::path kRepository =
    std::filesystem::path(__FILE__).parent_path().parent_path().parent_path().parent_path();

std::string textOf(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(kRepository / path).rdbuf();
  EXPECT_FALSE(text.str().empty()) << path;
  return text.str();
}

/// "max_error" and "MAX_ERROR" as "--max-error".
std::string optionName(std::string name) {
  for (char& c : name) c = c == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return "--" + name;
}

class OneName : public ::testing::Test {
 protected:
  void SetUp() override { declareProgram(app_, session_); }
  bool hasOption(const std::string& command, const std::string& name) const {
    const CLI::App& app = *app_.get_subcommand(command);
    return app.get_option_no_throw(name) != nullptr;
  }
  Session session_;
  CLI::App app_;
};

TEST_F(OneName, OfAnOpenOptionOfTheDriverIsThatOfExtract) {
  const std::string source = textOf("gis/driver/open_options.cpp");
  // A raster of square pixels is of the driver and of Python's to_xarray() alone.
  const std::set<std::string> own = {"CELL"};
  const std::regex option("Option name='([A-Z_]+)'");
  int count = 0;
  for (std::sregex_iterator match(source.begin(), source.end(), option), end; match != end; ++match, ++count)
    if (!own.contains((*match)[1].str())) {
      EXPECT_TRUE(hasOption("extract", optionName((*match)[1].str()))) << (*match)[1];
    }
  EXPECT_GE(count, 2);
}

TEST_F(OneName, OfAnArgumentInPythonIsThatOfTheCommand) {
  // What a program has and a command line has not: arrays, callbacks, and words that are a name in Python
  // alone.
  const std::map<std::string, std::set<std::string>> own = {
      {"cut", {"progress", "displaced", "where"}},
      {"height", {"x", "y", "progress"}},
      {"los", {"progress"}},
      {"profile", {"progress"}},
      {"viewshed", {"progress"}},
      {"build", {"source", "transform", "progress", "rim_tolerance"}}};
  const std::map<std::string, std::string> commandOf = {{"cut", "extract"}};
  const std::string source = textOf("python/arete/_model.py") + textOf("python/arete/_build.py");
  const std::regex function("\\n *def ([a-z_]+)\\(([^)]*)\\)"), argument("([a-z_]+):");
  std::set<std::string> seen;
  for (std::sregex_iterator match(source.begin(), source.end(), function), end; match != end; ++match) {
    const std::string name = (*match)[1], arguments = (*match)[2];
    const auto known = own.find(name);
    if (known == own.end()) continue;
    seen.insert(name);
    const std::string command = commandOf.contains(name) ? commandOf.at(name) : name;
    for (std::sregex_iterator one(arguments.begin(), arguments.end(), argument); one != end; ++one)
      if (const std::string word = (*one)[1]; !known->second.contains(word)) {
        EXPECT_TRUE(hasOption(command, optionName(word)))
            << name << "(" << word << "=) is no option of arete " << command
            << ": give both one name, or list it above as what only a program has";
      }
  }
  EXPECT_EQ(seen.size(), own.size());
}

}  // namespace
}  // namespace arete::cli_test
