// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <regex>

#include "cli/cli_fixture.h"

namespace arete::cli_test {
namespace {

class ManualCommand : public Cli {
 protected:
  /// What a shell prints; its exit code is expected to be 0.
  std::string shell(const std::string& text) const {
    write("script.sh", text);
    const std::string line = fmt::format("cd '{}' && bash script.sh > out.txt 2>&1", path("."));
    EXPECT_EQ(std::system(line.c_str()), 0) << read("out.txt");
    return read("out.txt");
  }
  /// What bash offers for the words of a line, the last of which is being typed.
  std::string completed(const std::string& words) const {
    return shell(
        fmt::format("source completion\nCOMP_WORDS=({})\nCOMP_CWORD=$((${{#COMP_WORDS[@]}} - 1))\n_arete\n"
                    "echo \"${{COMPREPLY[*]}}\"\n",
                    words));
  }
};

TEST_F(ManualCommand, WritesAPageForEveryCommandWithEveryOptionOfItsHelp) {
  const Outcome written = run({"manual", "--man", "man", "--json"});
  ASSERT_EQ(written.code, 0) << written.err;
  EXPECT_GE(written.json()["files"].size(), 17u);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"build"}, {"extract"}, {"los"}, {"mesh", "decimate"}, {"view"}}) {
    std::string name = "man/arete";
    for (const std::string& word : words) name += "-" + word;
    std::string page = read(name + ".1");
    EXPECT_EQ(page.rfind(".TH ARETE", 0), 0u) << name;
    std::string plain;
    for (const char c : page)
      if (c != '\\') plain += c;
    std::vector<std::string> help = words;
    help.push_back("--help");
    const std::string text = run(help).out;
    const std::regex option("\n +(?:-[a-z],)?(--[a-z0-9-]+)");
    int count = 0;
    for (std::sregex_iterator match(text.begin(), text.end(), option), end; match != end; ++match, ++count)
      EXPECT_NE(plain.find(fmt::format("fB{}fR", (*match)[1].str())), std::string::npos)
          << name << (*match)[1];
    EXPECT_GT(count, 5) << name;
    EXPECT_NE(page.find(".SH EXAMPLES"), std::string::npos) << name;
  }
  EXPECT_NE(read("man/arete.1").find("\\fBbuild\\fR"), std::string::npos);
}

TEST_F(ManualCommand, ItsPagesAreSoundForTheFormatter) {
  if (std::system("command -v groff > /dev/null") != 0) GTEST_SKIP() << "groff is not installed";
  ASSERT_EQ(run({"manual", "--man", "man"}).code, 0);
  EXPECT_EQ(shell("for page in man/*.1; do groff -man -Tutf8 -ww -z $page; done"), "");
}

TEST_F(ManualCommand, BashCompletesCommandsOptionsAndTheWordsOfAnOption) {
  const Outcome script = run({"manual", "--completion"});
  ASSERT_EQ(script.code, 0);
  write("completion", script.out);
  EXPECT_EQ(completed("arete ext"), "extract\n");
  EXPECT_EQ(completed("arete mesh dec"), "decimate\n");
  EXPECT_EQ(completed("arete build dem.tif --displ"), "--displacement\n");
  EXPECT_EQ(completed("arete los dem.amt --nodata bl"), "blocked\n");
  EXPECT_EQ(completed("arete los dem.amt --nodata ''"), "unknown clear blocked\n");
  EXPECT_EQ(completed("arete build de"), "\n") << "file names are bash's own";
  EXPECT_NE(completed("arete ''").find("viewshed"), std::string::npos);
}

TEST_F(ManualCommand, NeedsToKnowWhat) {
  EXPECT_EQ(run({"manual"}).code, 2);
  EXPECT_EQ(run({"manual", "--man", "x", "--completion"}).code, 2);
  write("file", "");
  const Outcome refused = run({"manual", "--man", "file/man"});
  EXPECT_EQ(refused.code, 3);
  EXPECT_NE(refused.err.find("file/man"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace arete::cli_test
