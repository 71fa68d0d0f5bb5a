// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two names are similar if one contains the other ("--triangles", "--max-triangles"), or if few letters have
// to be changed, left out or put in (the edit distance by dynamic programming, a row at a time). What other
// programs call an option is in a table.
#include "cli/arguments/unknown_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <string_view>
#include <utility>

namespace arete {
namespace {

constexpr std::size_t kShortestPart = 3, kMostSuggestions = 3;

std::string unknownCommand(const CLI::App& app, std::vector<std::string>::const_iterator word,
                           std::vector<std::string>::const_iterator end, const std::string& of) {
  if (word == end || word->starts_with('-')) return {};
  const std::vector<const CLI::App*> commands = app.get_subcommands({});
  if (commands.empty()) return {};
  std::string known;
  for (const CLI::App* command : commands) {
    if (command->get_name() == *word)
      return unknownCommand(*command, word + 1, end, of + " " + command->get_name());
    known += (known.empty() ? "" : ", ") + command->get_name();
  }
  return fmt::format("there is no command '{}'; the commands {}are {}", *word,
                     of.empty() ? "" : fmt::format("of{} ", of), known);
}

std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, changed}));
    }
  }
  return row.back();
}

/// How far a name is from another: 0 where one contains the other; npos where they are not similar.
std::size_t unlikeness(std::string_view unknown, std::string_view name) {
  if (unknown.size() >= kShortestPart && name.find(unknown) != std::string_view::npos) return 0;
  if (name.size() >= kShortestPart && unknown.find(name) != std::string_view::npos) return 0;
  const std::size_t distance = editDistance(unknown, name);
  return distance <= std::max<std::size_t>(1, unknown.size() / 3) ? distance : std::string_view::npos;
}

/// What other programs call an option of ours.
constexpr std::pair<std::string_view, std::string_view> kSynonyms[] = {{"tolerance", "max-error"},
                                                                       {"error", "max-error"},
                                                                       {"precision", "max-error"},
                                                                       {"epsilon", "max-error"},
                                                                       {"simplify", "max-error"},
                                                                       {"simplify", "max-triangles"},
                                                                       {"faces", "max-triangles"},
                                                                       {"target", "max-triangles"},
                                                                       {"ratio", "max-triangles"},
                                                                       {"tolerance", "expect"},
                                                                       {"max-error", "expect"},
                                                                       {"from", "observer"},
                                                                       {"from", "along"},
                                                                       {"to", "along"},
                                                                       {"max-distance", "radius"},
                                                                       {"csv", "points"},
                                                                       {"t-srs", "to-crs"},
                                                                       {"origin", "metric"},
                                                                       {"local", "metric"},
                                                                       {"count", "max-triangles"},
                                                                       {"percent", "max-triangles"},
                                                                       {"reduction", "max-triangles"},
                                                                       {"epsg", "crs"},
                                                                       {"srs", "crs"},
                                                                       {"t-srs", "crs"},
                                                                       {"s-srs", "crs"},
                                                                       {"a-srs", "crs"},
                                                                       {"projection", "crs"},
                                                                       {"bbox", "region"},
                                                                       {"bbox", "box"},
                                                                       {"extent", "region"},
                                                                       {"clip", "region"},
                                                                       {"mask", "region"},
                                                                       {"out", "output"},
                                                                       {"outfile", "output"},
                                                                       {"jobs", "threads"},
                                                                       {"cores", "threads"},
                                                                       {"silent", "quiet"},
                                                                       {"verbose", "progress"},
                                                                       {"force", "overwrite"},
                                                                       {"compress", "packed"},
                                                                       {"draco", "packed"},
                                                                       {"srcnodata", "nodata"},
                                                                       {"units", "unit"},
                                                                       {"scale", "unit"},
                                                                       {"holes", "fill-holes"},
                                                                       {"merge", "weld"},
                                                                       {"preserve-borders", "keep-borders"}};

std::vector<std::string> similarOptions(const CLI::App& command, std::string_view unknown) {
  std::vector<std::pair<std::size_t, std::string>> found;
  for (const auto& [other, ours] : kSynonyms)
    if (unknown == other && command.get_option_no_throw("--" + std::string(ours)) != nullptr)
      found.emplace_back(0, "--" + std::string(ours));
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames())
      if (const std::size_t unlike = unlikeness(unknown, name); unlike != std::string_view::npos)
        found.emplace_back(unlike, "--" + name);
  std::ranges::stable_sort(found, {}, &std::pair<std::size_t, std::string>::first);
  std::vector<std::string> names;
  for (const auto& [unlike, name] : found)
    if (names.size() < kMostSuggestions && std::ranges::find(names, name) == names.end())
      names.push_back(name);
  return names;
}

bool looksLikeOption(std::string_view word) {
  const std::size_t dashes = word.starts_with("--") ? 2 : 1;
  return word.starts_with('-') && word.size() > dashes &&
         std::isalpha(static_cast<unsigned char>(word[dashes])) != 0;
}

}  // namespace

std::string unknownCommand(const CLI::App& app, const std::vector<std::string>& words) {
  return unknownCommand(app, words.begin(), words.end(), {});
}

std::string unknownOption(const CLI::App& command, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (word == "--") break;
    if (!looksLikeOption(word)) continue;
    const bool isLong = word.starts_with("--");
    const std::string name = isLong ? word.substr(0, word.find('=')) : word.substr(0, 2);
    if (command.get_option_no_throw(name) != nullptr) continue;
    const std::vector<std::string> similar =
        isLong ? similarOptions(command, std::string_view(name).substr(2)) : std::vector<std::string>();
    // A tolerance belongs to a cut; as an option of build it resembles others that mean something else.
    if (command.get_name() == "build" &&
        (name == "--tolerance" || name == "--max-error" || name == "--max-triangles"))
      return fmt::format(
          "a model has every tolerance, and {} belongs to arete extract (--max-error, --max-triangles)",
          name);
    return fmt::format("there is no option {}{}{}", name,
                       similar.empty() ? "" : "; similar: ", fmt::join(similar, ", "));
  }
  return {};
}

}  // namespace arete
