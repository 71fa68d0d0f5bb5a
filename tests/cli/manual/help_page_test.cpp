// SPDX-License-Identifier: GPL-3.0-or-later
// The pages of --help and --help-all, of every command at several widths.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdlib>
#include <sstream>

#include "cli/cli_fixture.h"
#include "cli/commands/program.h"
#include "cli/manual/common_options.h"
#include "cli/manual/declarations.h"
#include "cli/manual/wrapped_text.h"

namespace arete::cli_test {
namespace {

class HelpPage : public ::testing::Test {
 protected:
  void SetUp() override { declareProgram(app_, session_); }
  void TearDown() override { unsetenv("COLUMNS"); }

  std::string page(const CLI::App& app, bool isWhole, std::size_t columns) const {
    setenv("COLUMNS", fmt::format("{}", columns).c_str(), 1);
    return app.help("", isWhole ? CLI::AppFormatMode::All : CLI::AppFormatMode::Normal);
  }
  static std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> all;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) all.push_back(line);
    return all;
  }
  /// The words of a page, to be compared whatever its lines.
  static std::string flowed(const std::string& text) {
    std::istringstream stream(text);
    std::string all;
    for (std::string word; stream >> word;) all += word + " ";
    return all;
  }

  Session session_;
  CLI::App app_;
};

TEST_F(HelpPage, KeepsToTheWidthOfTheTerminal) {
  for (const std::size_t columns : {40U, 60U, 80U, 100U, 120U})
    for (const DeclaredCommand& command : declaredCommands(app_))
      for (const bool isWhole : {false, true}) {
        bool isExample = false;
        for (const std::string& line : lines(page(*command.app, isWhole, columns))) {
          if (line == "Examples:" || line.empty()) isExample = line == "Examples:";
          // A word of a command is never broken, or it could not be pasted.
          if (isExample && line.find(' ', line.find_first_not_of(' ')) == std::string::npos) continue;
          if (isExample && columns < 60) continue;
          EXPECT_LE(line.size(), columns) << command.joined(" ") << "\n" << line;
          EXPECT_EQ(line.find_last_not_of(' ') + 1, line.size()) << "blanks at the end: " << line;
        }
      }
}

TEST_F(HelpPage, OfHelpAllHasEveryOptionAndThatOfHelpTheCommonOnes) {
  for (const DeclaredCommand& command : declaredCommands(app_)) {
    if (command.words.empty()) continue;
    SCOPED_TRACE(command.joined(" "));
    const std::string whole = page(*command.app, true, 120), common = page(*command.app, false, 120);
    const auto chosen = commonOptions(command.joined(" "));
    for (const DeclaredOption& option : declaredOptions(*command.app)) {
      const std::string entry = "\n  " + option.names.front();
      EXPECT_NE(whole.find(entry), std::string::npos) << entry;
      const auto isNamed = [&](std::string_view name) {
        return std::ranges::find(option.names, name) != option.names.end();
      };
      const bool isChosen = chosen.empty() || option.isArgument || option.isRequired || isNamed("--json") ||
                            isNamed("--quiet") || isNamed("--progress") || isNamed("--help") ||
                            isNamed("--help-all") || std::ranges::any_of(chosen, isNamed);
      EXPECT_EQ(common.find(entry + " ") != std::string::npos ||
                    common.find(entry + ",") != std::string::npos ||
                    common.find(entry + "\n") != std::string::npos,
                isChosen)
          << entry;
    }
    EXPECT_EQ(common.find("--help-all lists") != std::string::npos, !chosen.empty());
    EXPECT_EQ(common.find("Examples:") != std::string::npos, !command.app->get_footer().empty());
  }
}

TEST_F(HelpPage, CommonOptionsAreOptions) {
  for (const std::string_view name : commandsWithCommonOptions()) {
    const CLI::App* command = &app_;
    std::istringstream words{std::string(name)};
    for (std::string word; words >> word;) command = command->get_subcommand(word);
    for (const std::string_view option : commonOptions(name))
      EXPECT_NE(command->get_option_no_throw(std::string(option)), nullptr) << name << " " << option;
    EXPECT_LE(commonOptions(name).size(), 12u) << name << ": a handful";
  }
}

TEST_F(HelpPage, ConstraintsStandBehindWhatAnOptionDoes) {
  const std::string page = flowed(this->page(*app_.get_subcommand("extract"), true, 80));
  EXPECT_NE(page.find("Vertical field of view of the camera in degrees (default 60); with --camera only"),
            std::string::npos)
      << page;
  EXPECT_NE(page.find("not with --focus, --camera"), std::string::npos) << page;
  EXPECT_NE(page.find("results do not depend on it; from 1 to 4096"), std::string::npos) << page;
  for (const char* word : {"Needs:", "Excludes:", "REQUIRED", "INT in"})
    EXPECT_EQ(page.find(word), std::string::npos) << word;
}

TEST_F(HelpPage, ExamplesStayCommandsThatCanBePasted) {
  for (const std::size_t columns : {40U, 60U, 80U}) {
    const std::string text = page(*app_.get_subcommand("extract"), false, columns);
    std::string joined = text;
    for (std::size_t at = 0; (at = joined.find(" \\\n", at)) != std::string::npos;) {
      const std::size_t next = joined.find_first_not_of(' ', at + 3);
      joined.replace(at, next - at, " ");
    }
    EXPECT_NE(joined.find(
                  "  arete extract dem.amt -o tin.ply --max-error 1 --region park.gpkg --outside-error 20\n"),
              std::string::npos)
        << text;
  }
  EXPECT_EQ(wrappedCommand("  arete info dem.amt     what is in it", 30),
            "  arete info dem.amt\n      # what is in it\n");
}

TEST_F(HelpPage, TakesColumnsThatMakeSense) {
  const std::pair<const char*, std::size_t> cases[] = {{"100", 100}, {"40", 40},    {"10", 40},
                                                       {"1", 40},    {"9999", 120}, {"120", 120}};
  for (const auto& [text, columns] : cases) {
    setenv("COLUMNS", text, 1);
    EXPECT_EQ(terminalColumns(), columns) << text;
  }
  unsetenv("COLUMNS");
  const std::size_t unstated = terminalColumns();
  for (const char* text : {"", "0", "-5", "80x", "wide", " 60", "1e2", "99999999999999999999999"}) {
    setenv("COLUMNS", text, 1);
    EXPECT_EQ(terminalColumns(), unstated) << text;
  }
}

TEST(WrappedText, PartsAtBlanksAndBreaksOnlyWhatIsTooLong) {
  EXPECT_EQ(wrapped("one two three", 8, 0, 2), "one two\n  three\n");
  EXPECT_EQ(wrapped("one two three", 8, 6, 2), "\n  one\n  two\n  three\n");
  EXPECT_EQ(wrapped("", 8, 0, 2), "\n");
  EXPECT_EQ(wrapped("a\nb  c", 8, 0, 0), "a b c\n") << "line ends of a text are blanks";
  EXPECT_EQ(wrapped("abcd,efgh,ijkl", 12, 0, 2), "abcd,efgh,\n  ijkl\n");
  EXPECT_EQ(wrapped("abcdefghijkl", 8, 0, 2), "abcdefgh\n  ijkl\n");
  EXPECT_EQ(wrapped("\u00e4\u00e4\u00e4 \u00e4\u00e4\u00e4", 7, 0, 0),
            "\u00e4\u00e4\u00e4 \u00e4\u00e4\u00e4\n")
      << "a letter of two bytes fills one column";
}

class HelpCommand : public Cli {};

TEST_F(HelpCommand, ShowsAllOfACommandAndOfTheProgram) {
  const Outcome all = run({"mesh", "decimate", "--help-all"});
  EXPECT_EQ(all.code, 0);
  EXPECT_NE(all.out.find("--no-crossings"), std::string::npos);
  EXPECT_EQ(run({"help", "mesh", "decimate", "--help-all"}).out, all.out);
  EXPECT_EQ(run({"mesh", "decimate", "--help"}).out.find("--no-crossings"), std::string::npos);
  const Outcome program = run({"--help-all"});
  EXPECT_EQ(program.code, 0);
  EXPECT_NE(program.out.find(all.out), std::string::npos) << "the pages of all commands";
  EXPECT_NE(run({"--help"}).out.find("--help-all shows all"), std::string::npos);
  EXPECT_EQ(run({"extract", "--help-al"}).code, 2);
}

}  // namespace
}  // namespace arete::cli_test
