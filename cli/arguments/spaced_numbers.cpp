// SPDX-License-Identifier: GPL-3.0-or-later
//
// A number behind the value of an option that takes one does not belong to any command, unless a file has
// that name.
#include "cli/arguments/spaced_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace arete {
namespace {

/// "390000", "-1.5", "390000,3800000", "30agl": numbers with commas between, the last perhaps with a word.
bool looksLikeNumbers(std::string_view word) {
  while (!word.empty() && std::isalpha(static_cast<unsigned char>(word.back()))) word.remove_suffix(1);
  return !word.empty() && word.find_first_of("0123456789") != word.npos &&
         word.find_first_not_of("0123456789.,+-eE") == word.npos;
}

bool isFileName(const std::string& word) {
  std::error_code ignored;
  return std::filesystem::exists(word, ignored);
}

/// "X,Y,H", "FILE|BOX".
bool takesCommas(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type.find(',') != type.npos || type.ends_with("BOX");
}

const CLI::App& namedCommand(const CLI::App& app, const std::vector<std::string>& words, std::size_t& at) {
  const CLI::App* command = &app;
  for (at = 0; at < words.size(); ++at) {
    const CLI::App* below = nullptr;
    for (const CLI::App* each : command->get_subcommands({}))
      if (each->get_name() == words[at]) below = each;
    if (!below) break;
    command = below;
  }
  return *command;
}

}  // namespace

std::string spacedNumbers(const CLI::App& app, const std::vector<std::string>& words) {
  std::size_t at = 0;
  const CLI::App& command = namedCommand(app, words, at);
  for (; at + 2 < words.size(); ++at) {
    const std::string& name = words[at];
    if (name == "--") break;
    if (!name.starts_with('-') || name.find('=') != name.npos) continue;
    const CLI::Option* option = command.get_option_no_throw(name);
    if (!option || !takesCommas(*option)) continue;
    std::size_t end = at + 1;
    while (end < words.size() && looksLikeNumbers(words[end]) && !isFileName(words[end])) ++end;
    if (end < at + 3) continue;
    // An option that is repeated may have several values behind one name, each with commas.
    const auto hasComma = [](const std::string& word) { return word.find(',') != word.npos; };
    if (option->get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll &&
        std::any_of(words.begin() + std::ptrdiff_t(at) + 1, words.begin() + std::ptrdiff_t(end), hasComma))
      continue;
    std::string apart = name, joined = name + " ";
    for (std::size_t i = at + 1; i < end; ++i) {
      apart += " " + words[i];
      std::string_view part = words[i];
      while (part.ends_with(',')) part.remove_suffix(1);
      joined += (i == at + 1 ? "" : ",") + std::string(part);
    }
    return fmt::format("{}: numbers of one option are joined with commas: {}", apart, joined);
  }
  return {};
}

}  // namespace arete
