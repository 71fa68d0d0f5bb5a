// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/glb/texture_options.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "io/files/text_scan.h"

namespace arete {
namespace {

std::vector<std::string_view> wordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at < line.size();) {
    while (at < line.size() && text::isSpace(line[at])) ++at;
    const std::size_t from = at;
    while (at < line.size() && !text::isSpace(line[at])) ++at;
    if (at > from) words.push_back(line.substr(from, at - from));
  }
  return words;
}

std::optional<double> numberOf(std::string_view word) {
  double number = 0;
  const char* at = word.data();
  const bool isNumber = text::scanNumber(at, word.data() + word.size(), number);
  return isNumber && at == word.data() + word.size() && std::isfinite(number) ? std::optional(number)
                                                                              : std::nullopt;
}

struct Option {
  std::string name;
  std::vector<std::string_view> values;
};

/// A word is an option if it begins with a minus and does not parse as a number.
std::vector<Option> optionsOf(std::string_view text) {
  std::vector<Option> options;
  for (const std::string_view word : wordsOf(text)) {
    if (word.size() > 1 && word.front() == '-' && !numberOf(word))
      options.push_back({text::lowered(word), {}});
    else if (!options.empty())
      options.back().values.push_back(word);
  }
  return options;
}

void takePair(const Option& option, std::array<double, 2>& to) {
  for (std::size_t i = 0; i < std::min<std::size_t>(2, option.values.size()); ++i)
    if (const auto number = numberOf(option.values[i])) to[i] = *number;
}

void addTo(std::string& text, const Option& option) {
  text += (text.empty() ? "" : " ") + option.name;
  for (const std::string_view value : option.values) text += " " + std::string(value);
}

bool isDefault(const Option& option) {
  const std::string value = option.values.empty() ? std::string() : text::lowered(option.values.front());
  if (option.name == "-blendu" || option.name == "-blendv") return value == "on";
  if (option.name == "-clamp" || option.name == "-cc") return value == "off";
  if (option.name == "-mm")
    return option.values.size() == 2 && numberOf(option.values[0]) == 0.0 &&
           numberOf(option.values[1]) == 1.0;
  if (option.name == "-t") {
    for (const std::string_view word : option.values)
      if (numberOf(word) != 0.0) return false;
    return true;
  }
  return false;
}

}  // namespace

MtlPlacing mtlPlacingOf(std::string_view options) {
  MtlPlacing placing;
  for (const Option& option : optionsOf(options)) {
    if (option.name == "-s")
      takePair(option, placing.scale);
    else if (option.name == "-o")
      takePair(option, placing.offset);
    else if (option.name == "-clamp" && !option.values.empty() && text::lowered(option.values[0]) == "on")
      placing.clamps = true;
    else if (option.name == "-bm" && !option.values.empty() && numberOf(option.values[0]))
      placing.bump = numberOf(option.values[0]);
    else if (!isDefault(option))
      addTo(placing.others, option);
  }
  return placing;
}

std::string withoutMtlPlacing(std::string_view options) {
  std::string others;
  for (const Option& option : optionsOf(options))
    if (option.name != "-s" && option.name != "-o") addTo(others, option);
  return others;
}

}  // namespace arete
