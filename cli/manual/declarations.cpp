// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/manual/declarations.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace arete {
namespace {

void collect(const CLI::App& app, std::vector<std::string> words, std::vector<DeclaredCommand>& all) {
  all.push_back({words, &app});
  for (const CLI::App* command : app.get_subcommands({})) {
    std::vector<std::string> longer = words;
    longer.push_back(command->get_name());
    collect(*command, std::move(longer), all);
  }
}

/// "a|b|c" of lower-case words as words.
std::vector<std::string> choicesOf(const std::string& value) {
  const bool isPlain = std::ranges::all_of(value, [](unsigned char c) {
    return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '-' || c == '|';
  });
  if (!isPlain || value.find('|') == std::string::npos) return {};
  std::vector<std::string> choices(1);
  for (const char c : value) {
    if (c == '|')
      choices.emplace_back();
    else
      choices.back() += c;
  }
  return choices;
}

/// The long names of some options, in the order in which the command declares them.
std::string namesOf(const CLI::App& app, const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options({}))
    if (options.contains(const_cast<CLI::Option*>(option))) names.push_back(option->get_name());
  return fmt::format("{}", fmt::join(names, ", "));
}

/// What a check of the parser's own adds to the type, "N:INT in [1 - 4096]", in words.
std::string rangeOf(const std::string& type) {
  const std::size_t open = type.find(" in ["), between = type.find(" - ", std::min(open, type.size()));
  if (open == type.npos || between == type.npos || !type.ends_with(']')) return {};
  return fmt::format("from {} to {}", type.substr(open + 5, between - open - 5),
                     type.substr(between + 3, type.size() - between - 4));
}

std::vector<std::string> constraintsOf(const CLI::App& app, const CLI::Option& option) {
  std::vector<std::string> all;
  if (option.get_required() && option.nonpositional()) all.emplace_back("required");
  if (const std::string range = rangeOf(option.get_type_name()); !range.empty()) all.push_back(range);
  if (!option.get_needs().empty())
    all.push_back(fmt::format("with {} only", namesOf(app, option.get_needs())));
  if (!option.get_excludes().empty())
    all.push_back(fmt::format("not with {}", namesOf(app, option.get_excludes())));
  return all;
}

}  // namespace

std::string DeclaredOption::textWithConstraints() const {
  std::string whole = text;
  for (const std::string& constraint : constraints) whole += "; " + constraint;
  return whole;
}

std::string DeclaredCommand::joined(std::string_view between) const {
  return fmt::format("{}", fmt::join(words, between));
}

std::vector<DeclaredCommand> declaredCommands(const CLI::App& program) {
  std::vector<DeclaredCommand> all;
  collect(program, {}, all);
  return all;
}

std::vector<DeclaredOption> declaredOptions(const CLI::App& app) {
  std::vector<DeclaredOption> all;
  for (const CLI::Option* option : app.get_options({})) {
    if (option->get_group().empty()) continue;  // hidden
    DeclaredOption one;
    one.isArgument = !option->nonpositional();
    for (const std::string& name : option->get_snames()) one.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) one.names.push_back("--" + name);
    if (one.isArgument) one.names = {option->get_name(true)};
    if (!one.isArgument && option->get_expected_max() > 0 && option->get_type_size_max() > 0) {
      one.value = option->get_type_name();
      // What a check adds: "N:INT in [1 - 4096]".
      one.value = one.value.substr(0, one.value.find(':'));
      if (one.value.empty()) one.value = "VALUE";
      one.choices = choicesOf(one.value);
    }
    one.text = option->get_description();
    std::ranges::replace(one.text, '\n', ' ');
    one.group = option->get_group();
    one.isRequired = option->get_required();
    one.constraints = constraintsOf(app, *option);
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace arete
