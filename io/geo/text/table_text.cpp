// SPDX-License-Identifier: GPL-3.0-or-later
//
// Suffixes are added until a name is unique among ours and among the names before it.
#include "io/geo/text/table_text.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace arete {
namespace {

bool isSameName(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char p, unsigned char q) { return std::tolower(p) == std::tolower(q); });
}

}  // namespace

std::vector<std::string> namesBeside(const PointAttributes& attributes,
                                     std::span<const std::string_view> ours) {
  std::vector<std::string> names;
  const auto isTaken = [&](const std::string& name) {
    const auto isIt = [&](std::string_view other) { return isSameName(name, other); };
    return std::any_of(ours.begin(), ours.end(), isIt) || std::any_of(names.begin(), names.end(), isIt);
  };
  for (const auto& column : attributes.columns) {
    std::string name = column.name;
    while (isTaken(name)) name += "_in";
    names.push_back(std::move(name));
  }
  return names;
}

void appendCsvField(std::string& line, std::string_view value) {
  if (value.find_first_of(",\"\r\n#") == std::string_view::npos) {
    line += value;
    return;
  }
  line += '"';
  for (const char c : value) line += c == '"' ? std::string_view("\"\"") : std::string_view(&c, 1);
  line += '"';
}

}  // namespace arete
