// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/text/separator.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "io/geo/text/cell_number.h"

namespace arete {

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

namespace {

std::string_view unquoted(std::string_view text) {
  text = trimmed(text);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return trimmed(text);
}

/// How many fields are numbers, and how many commas are their decimal signs.
struct Numbers {
  std::ptrdiff_t count = 0, commas = 0;
};

Numbers numbersIn(std::string_view line, char separator) {
  Numbers numbers;
  for (const std::string_view field : fieldsOf(line, separator)) {
    const CellNumber number = readCell(field);
    if (number.kind != CellNumber::Kind::number) continue;
    ++numbers.count;
    numbers.commas += number.hasDecimalComma ? 1 : 0;
  }
  return numbers;
}

}  // namespace

bool nextField(std::string_view& rest, char separator, std::string_view& field) {
  if (separator == kSpaces) {
    rest = trimmed(rest);
    if (rest.empty()) return false;
    std::size_t end = 0;
    while (end < rest.size() && !isBlank(rest[end])) ++end;
    field = unquoted(rest.substr(0, end));
    rest.remove_prefix(end);
    return true;
  }
  if (rest.data() == nullptr) return false;
  std::size_t end = 0;
  bool inQuotes = false;
  for (; end < rest.size() && (inQuotes || rest[end] != separator); ++end)
    if (rest[end] == '"') inQuotes = !inQuotes;
  field = unquoted(rest.substr(0, end));
  rest = end < rest.size() ? rest.substr(end + 1) : std::string_view();
  return true;
}

std::vector<std::string_view> fieldsOf(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  for (std::string_view field; nextField(line, separator, field);) fields.push_back(field);
  return fields;
}

char separatorOf(std::string_view line) {
  const auto has = [&](char separator) { return line.find(separator) != std::string_view::npos; };
  if (has(';')) return ';';
  if (const std::ptrdiff_t commas = std::ranges::count(line, ','); commas > 0) {
    for (const char separator : std::array{'\t', '|', kSpaces})
      if (separator == kSpaces || has(separator))
        if (const Numbers numbers = numbersIn(line, separator);
            numbers.count >= 2 && numbers.commas == commas)
          return separator;
    return ',';
  }
  if (has('\t')) return '\t';
  if (has('|') && numbersIn(line, kSpaces).count < 2) return '|';
  return kSpaces;
}

}  // namespace arete
