// SPDX-License-Identifier: GPL-3.0-or-later
//
// A page is made of the declarations, as a manual page is. Names stand in a column at the left if there is
// room for one, else above their texts.
#include "cli/manual/help_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/manual/common_options.h"
#include "cli/manual/declarations.h"
#include "cli/manual/wrapped_text.h"
#include "engine/base/counted.h"

namespace arete {
namespace {

constexpr std::size_t kNarrow = 64, kWide = 100;

/// The words that lead to a command, without "arete".
std::string wordsTo(const CLI::App& app) {
  const CLI::App* parent = app.get_parent();
  if (parent == nullptr) return {};
  const std::string before = wordsTo(*parent);
  return before.empty() ? app.get_name() : before + " " + app.get_name();
}

class HelpPage {
 public:
  HelpPage(const CLI::App& app, bool isWhole)
      : app_(app), isWhole_(isWhole), columns_(terminalColumns()), options_(declaredOptions(app)) {}

  std::string text() {
    page_ = wrapped(app_.get_description(), columns_, 0, 0) + "\n";
    addUsage();
    addArguments();
    const std::vector<const CLI::App*> below = app_.get_subcommands({});
    if (!below.empty()) {
      page_ += "\nCommands:\n";
      for (const CLI::App* one : below) addEntry(one->get_name(), one->get_description());
    }
    const std::span<const std::string_view> common = commonOptions(wordsTo(app_));
    if (isWhole_ || common.empty())
      addGroups();
    else
      addCommon(common);
    addFooter();
    if (!isWhole_ && !common.empty())
      page_ += "\n" + wrapped(fmt::format("{} --help-all lists {}.", named(),
                                          counted(options_.size() - shown_, "more option", "more options")),
                              columns_, 0, 0);
    return page_;
  }

 private:
  std::string named() const {
    const std::string words = wordsTo(app_);
    return words.empty() ? "arete" : "arete " + words;
  }

  void addUsage() {
    std::string usage = named() + (app_.get_subcommands({}).empty() ? " [OPTIONS]" : " COMMAND [OPTIONS]");
    for (const DeclaredOption& option : options_)
      if (option.isArgument)
        usage += option.isRequired ? " " + option.names[0] : fmt::format(" [{}]", option.names[0]);
    page_ += "Usage: " + wrapped(usage, columns_, 7, 7);
  }

  void addArguments() {
    const auto isArgument = [](const DeclaredOption& option) { return option.isArgument; };
    if (std::ranges::none_of(options_, isArgument)) return;
    page_ += "\nArguments:\n";
    for (const DeclaredOption& option : options_)
      if (option.isArgument) {
        addEntry(option.names[0], option.text);
        ++shown_;
      }
  }

  void addOption(const DeclaredOption& option) {
    addEntry(
        fmt::format("{}{}{}", fmt::join(option.names, ", "), option.value.empty() ? "" : " ", option.value),
        option.textWithConstraints());
    ++shown_;
  }

  void addCommon(std::span<const std::string_view> common) {
    page_ += "\nCommon options:\n";
    const auto add = [&](std::string_view name) {
      for (const DeclaredOption& option : options_)
        if (std::ranges::find(option.names, name) != option.names.end()) addOption(option);
    };
    for (const std::string_view name : common) add(name);
    const auto isListed = [&](const DeclaredOption& option) {
      return std::ranges::any_of(option.names, [&](const std::string& name) {
        return std::ranges::find(common, name) != common.end();
      });
    };
    // What is required is shown, whatever the table says.
    for (const DeclaredOption& option : options_)
      if (option.isRequired && !option.isArgument && !isListed(option)) addOption(option);
    for (const std::string_view name : {"--json", "--quiet", "--progress", "--help", "--help-all"}) add(name);
  }

  void addGroups() {
    std::vector<std::string> groups;
    for (const DeclaredOption& option : options_)
      if (!option.isArgument && std::ranges::find(groups, option.group) == groups.end())
        groups.push_back(option.group);
    // What every command has comes last.
    std::ranges::stable_partition(groups, [](const std::string& group) { return group != "Output"; });
    for (const std::string& group : groups) {
      page_ += fmt::format("\n{}:\n", group);
      for (const DeclaredOption& option : options_)
        if (!option.isArgument && option.group == group) addOption(option);
    }
  }

  /// The paragraphs behind the options: of "Examples:" the lines are commands, an indented line stays one.
  void addFooter() {
    std::string footer = app_.get_footer();
    if (!footer.empty()) page_ += '\n';
    bool areCommands = false;
    std::string paragraph;
    const auto endParagraph = [&] {
      if (!paragraph.empty()) page_ += wrapped(paragraph, columns_, 0, 0);
      paragraph.clear();
    };
    for (std::size_t at = 0; at < footer.size();) {
      const std::size_t end = std::min(footer.find('\n', at), footer.size());
      const std::string line = footer.substr(at, end - at);
      at = end + 1;
      if (line == "Examples:") areCommands = true;
      if (line.empty()) {
        endParagraph();
        areCommands = false;
        page_ += '\n';
      } else if (line.starts_with(' ') || line.ends_with(':')) {
        endParagraph();
        page_ += areCommands ? wrappedCommand(line, columns_) : tableLine(line);
      } else {
        paragraph += " " + line;
      }
    }
    endParagraph();
  }

  /// "    3  a file is missing": the text behind the gap is wrapped below itself.
  std::string tableLine(const std::string& line) const {
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    const std::size_t gap = line.find("  ", begin);
    if (gap == std::string::npos) return wrapped(line, columns_, 0, 0);
    const std::size_t text = line.find_first_not_of(' ', gap);
    return line.substr(0, text) + wrapped(line.substr(text), columns_, text, text);
  }

  void addEntry(const std::string& name, const std::string& text) {
    const std::size_t left = columns_ < kNarrow ? 6 : columns_ < kWide ? 26 : 30;
    const bool isBeside = columns_ >= kNarrow && 2 + name.size() + 2 <= left;
    if (isBeside)
      page_ += fmt::format("  {:<{}}", name, left - 2);
    else
      page_ += "  " + wrapped(name, columns_, 2, 6) + std::string(left, ' ');
    page_ += wrapped(text, columns_, left, left);
  }

  const CLI::App& app_;
  bool isWhole_;
  std::size_t columns_, shown_ = 0;
  std::vector<DeclaredOption> options_;
  std::string page_;
};

class HelpPages : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode mode) const override {
    const bool isWhole = mode != CLI::AppFormatMode::Normal;
    std::string text = HelpPage(*app, isWhole).text();
    if (isWhole)
      for (const CLI::App* below : app->get_subcommands({})) text += "\n\n" + make_help(below, {}, mode);
    return text;
  }
};

}  // namespace

std::shared_ptr<CLI::FormatterBase> helpPages() {
  return std::make_shared<HelpPages>();
}

}  // namespace arete
