// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every value of a column is tried as an integer, then as a double. A leading zero marks a code, such as a
// postal code, that must stay a text.
#include "io/geo/text/point_attributes.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <system_error>

namespace arete {
namespace {

template <class Number>
bool isWholly(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

PointAttributes::Kind kindOfText(std::string_view text) {
  using Kind = PointAttributes::Kind;
  const std::string_view digits = text.substr(text.front() == '-' ? 1 : 0);
  if (digits.size() > 1 && digits[0] == '0' && digits[1] >= '0' && digits[1] <= '9') return Kind::text;
  if (isWholly<std::int64_t>(text)) return Kind::integer;
  // An integer of more digits is the name of something: no number of 64 bits has them all.
  const bool isInteger = std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; });
  return !isInteger && isWholly<double>(text) ? Kind::real : Kind::text;
}

}  // namespace

void PointAttributes::findKinds() {
  for (std::size_t c = 0; c < columns.size(); ++c) {
    bool any = false, allIntegers = true, allNumbers = true;
    for (std::size_t r = 0; r < rows() && allNumbers; ++r) {
      const std::string_view value = at(r, c);
      if (value.empty()) continue;
      any = true;
      const Kind kind = kindOfText(value);
      allIntegers = allIntegers && kind == Kind::integer;
      allNumbers = allNumbers && kind != Kind::text;
    }
    if (any && allNumbers) columns[c].kind = allIntegers ? Kind::integer : Kind::real;
  }
}

}  // namespace arete
