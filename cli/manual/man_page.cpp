// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/manual/man_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "cli/session/exit_code.h"

namespace arete {
namespace {

/// Text of a line: no character of it is taken for a request or a font.
std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\\')
      safe += "\\\\";
    else if (c == '-')
      safe += "\\-";
    else if ((c == '.' || c == '\'') && (safe.empty() || safe.back() == '\n'))
      safe += std::string("\\&") + c;
    else
      safe += c;
  }
  return safe;
}

/// "arete mesh info", or with "-" between.
std::string named(const DeclaredCommand& command, std::string_view between) {
  return command.words.empty() ? "arete" : fmt::format("arete{}{}", between, command.joined(between));
}

void addOptions(const std::vector<DeclaredOption>& options, const std::string& group, bool areArguments,
                std::string& page) {
  for (const DeclaredOption& option : options) {
    if (option.isArgument != areArguments || (!areArguments && option.group != group)) continue;
    page += ".TP\n";
    std::string names;
    for (const std::string& name : option.names)
      names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", escaped(name));
    if (!option.value.empty()) names += fmt::format(" \\fI{}\\fR", escaped(option.value));
    page += names + "\n" + escaped(option.textWithConstraints()) + "\n";
  }
}

void addVerbatim(const std::string& text, std::string& page) {
  page += ".nf\n" + escaped(text) + "\n.fi\n";
}

}  // namespace

std::string pageName(const DeclaredCommand& command) {
  return named(command, "-");
}

std::string manPage(const DeclaredCommand& command, const CLI::App& program) {
  std::string summary = command.app->get_description();
  std::ranges::replace(summary, '\n', ' ');
  std::string upper = pageName(command);
  std::ranges::transform(upper, upper.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string page = fmt::format(".TH {} 1 \"\" \"Arete {}\" \"Arete\"\n", escaped(upper), ARETE_VERSION);
  page += fmt::format(".SH NAME\n{} \\- {}\n", escaped(pageName(command)), escaped(summary));

  const std::vector<DeclaredOption> options = declaredOptions(*command.app);
  const std::vector<const CLI::App*> below = command.app->get_subcommands({});
  page += fmt::format(".SH SYNOPSIS\n\\fB{}\\fR", escaped(named(command, " ")));
  page += below.empty() ? " [\\fIOPTIONS\\fR]" : " \\fICOMMAND\\fR [\\fIOPTIONS\\fR]";
  for (const DeclaredOption& option : options)
    if (option.isArgument)
      page += fmt::format("{}\\fI{}\\fR{}", option.isRequired ? " " : " [", escaped(option.names[0]),
                          option.isRequired ? "" : "]");
  page += "\n";
  if (!below.empty()) {
    page += ".SH COMMANDS\n";
    for (const CLI::App* one : below)
      page += fmt::format(".TP\n\\fB{}\\fR\n{}\n", escaped(one->get_name()), escaped(one->get_description()));
  }
  if (std::ranges::any_of(options, &DeclaredOption::isArgument)) {
    page += ".SH ARGUMENTS\n";
    addOptions(options, {}, true, page);
  }
  page += ".SH OPTIONS\n";
  std::vector<std::string> groups;
  for (const DeclaredOption& option : options)
    if (!option.isArgument && std::ranges::find(groups, option.group) == groups.end())
      groups.push_back(option.group);
  for (const std::string& group : groups) {
    if (group != "Options") page += fmt::format(".SS {}\n", escaped(group));
    addOptions(options, group, false, page);
  }
  // The footer is "Examples:" and lines, of the program with the exit codes behind them.
  std::string footer = command.app->get_footer();
  const std::string_view heading = "Examples:\n";
  if (footer.starts_with(heading)) {
    footer.erase(0, heading.size());
    if (const std::size_t end = footer.find("\n\n"); end != std::string::npos) footer.resize(end);
    page += ".SH EXAMPLES\n";
    addVerbatim(footer, page);
  }
  page += ".SH EXIT STATUS\n";
  addVerbatim(std::string(exitCodeTable()), page);
  page += ".SH SEE ALSO\n";
  std::string others;
  for (const DeclaredCommand& other : declaredCommands(program))
    if (pageName(other) != pageName(command))
      others += fmt::format("{}\\fB{}\\fR(1)", others.empty() ? "" : ",\n", escaped(pageName(other)));
  return page + others + "\n";
}

}  // namespace arete
