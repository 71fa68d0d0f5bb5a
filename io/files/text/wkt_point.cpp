// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/text/wkt_point.h"

#include <charconv>
#include <cmath>
#include <string>
#include <system_error>
#include <vector>

#include "io/files/number_text.h"
#include "io/files/text_scan.h"

namespace arete {
namespace {

void skipSpaces(std::string_view& text) {
  while (!text.empty() && text::isSpace(text.front())) text.remove_prefix(1);
}

/// Takes a word off the front, in lower case and with blanks before it. False if another one stands there.
bool take(std::string_view& text, std::string_view word) {
  skipSpaces(text);
  if (text::lowered(text.substr(0, word.size())) != word) return false;
  text.remove_prefix(word.size());
  return true;
}

/// The numbers up to a closing bracket; nothing if there are other texts.
std::optional<std::vector<double>> takeNumbers(std::string_view& text) {
  std::vector<double> numbers;
  for (;;) {
    skipSpaces(text);
    if (take(text, ")")) return numbers;
    std::size_t end = 0;
    while (end < text.size() && !text::isSpace(text[end]) && text[end] != ')') ++end;
    const std::optional<double> number = text::parseNumber(text.substr(0, end));
    if (!number || !std::isfinite(*number) || numbers.size() == 4) return std::nullopt;
    numbers.push_back(*number);
    text.remove_prefix(end);
  }
}

bool takeSrid(std::string_view& text, int& srid) {
  if (!take(text, "srid=")) return true;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), srid);
  if (error != std::errc{} || srid < 0) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return take(text, ";");
}

}  // namespace

std::optional<WktPoint> readWktPoint(std::string_view text) {
  WktPoint point;
  if (!takeSrid(text, point.srid)) return std::nullopt;
  const bool isMulti = take(text, "multipoint");
  if (!isMulti && !take(text, "point")) return std::nullopt;
  const bool hasZ = take(text, "z"), hasM = take(text, "m");
  const auto isAtEnd = [&] {
    skipSpaces(text);
    return text.empty();
  };
  if (take(text, "empty")) return isAtEnd() ? std::optional(point) : std::nullopt;
  if (!take(text, "(")) return std::nullopt;
  const bool hasOwn = isMulti && take(text, "(");
  const auto numbers = takeNumbers(text);
  if (!numbers || (hasOwn && !take(text, ")")) || !isAtEnd()) return std::nullopt;
  const std::size_t stated = 2 + (hasZ ? 1u : 0u) + (hasM ? 1u : 0u), count = numbers->size();
  if (count < 2 || ((hasZ || hasM) && count != stated)) return std::nullopt;
  point.place = Vec2{(*numbers)[0], (*numbers)[1]};
  if (hasZ || (!hasM && count > 2)) point.z = (*numbers)[2];
  return point;
}

}  // namespace arete
