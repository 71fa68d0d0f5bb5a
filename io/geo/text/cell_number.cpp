// SPDX-License-Identifier: GPL-3.0-or-later
//
// Plain numbers come first, since nearly all are. Others are rewritten as one, if only one reading makes
// sense.
#include "io/geo/text/cell_number.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "io/files/number_text.h"
#include "io/files/text_scan.h"

namespace arete {

namespace {

/// In lower case, and without a sign. "1.#qnan" and "1.#ind" are those of older C libraries on Windows.
constexpr std::array<std::string_view, 13> kMissing = {
    "", "nan", "na", "n/a", "null", "none", "nil", "-", "--", "1.#qnan", "1.#ind", "1.#nan", "nan(ind)"};

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

bool isMissing(std::string_view field) {
  const std::string lower = text::lowered(field);
  const auto is = [](std::string_view text) { return std::ranges::find(kMissing, text) != kMissing.end(); };
  const bool hasSign = !lower.empty() && (lower[0] == '+' || lower[0] == '-');
  return is(lower) ||
         (hasSign && lower.size() > 1 && is(std::string_view(lower).substr(1)) && lower[1] != '-');
}

/// Three digits behind the comma, and one to three before it.
bool looksGrouped(std::string_view field, std::size_t comma) {
  const std::size_t from = !field.empty() && (field[0] == '+' || field[0] == '-') ? 1 : 0;
  return field.size() == comma + 4 && comma > from && comma - from <= 3 &&
         std::all_of(field.begin() + std::ptrdiff_t(comma) + 1, field.end(), isDigit);
}

}  // namespace

CellNumber readCell(std::string_view field) {
  using Kind = CellNumber::Kind;
  if (const std::optional<double> value = text::parseNumber(field)) {
    if (std::isnan(*value)) return {.kind = Kind::missing};
    return {.kind = Kind::number, .value = *value};
  }
  if (isMissing(field)) return {.kind = Kind::missing};
  // Only digits, signs and one letter of an exponent: "D", as Fortran writes it.
  std::string plain(field);
  const std::size_t comma = plain.find(','), exponent = plain.find_first_of("dD");
  const bool hasComma = comma != std::string::npos, hasExponent = exponent != std::string::npos;
  if (!hasComma && !hasExponent) return {};
  if (hasComma) {
    const bool isBetweenDigits =
        comma > 0 && comma + 1 < plain.size() && isDigit(plain[comma - 1]) && isDigit(plain[comma + 1]);
    if (!isBetweenDigits || plain.find('.') != std::string::npos ||
        plain.find(',', comma + 1) != std::string::npos)
      return {};
    plain[comma] = '.';
  }
  if (hasExponent) plain[exponent] = 'e';
  const std::optional<double> value = text::parseNumber(plain);
  if (!value || std::isnan(*value)) return {};
  return {.kind = Kind::number,
          .value = *value,
          .hasDecimalComma = hasComma,
          .mayBeGrouped = hasComma && looksGrouped(field, comma)};
}

std::string whyNotANumber(std::string_view field) {
  std::string why = "is not a number";
  const bool hasDigit = std::ranges::any_of(field, isDigit),
             hasComma = field.find(',') != std::string_view::npos;
  if (hasDigit && hasComma && field.find('.') != std::string_view::npos)
    why += ": it has a point and a comma, of which one groups digits";
  else if (hasDigit && std::ranges::count(field, ',') > 1)
    why += ": it has several commas";
  else if (hasDigit &&
           (field.find('\'') != std::string_view::npos || field.find(' ') != std::string_view::npos ||
            field.find("\xC2\xA0") != std::string_view::npos))
    why += ": digits must not be grouped";
  return why;
}

}  // namespace arete
