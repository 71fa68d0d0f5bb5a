// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

#include "io/files/text_scan.h"

namespace arete::text {

/// The text without spaces at either end.
inline std::string_view withoutSpaces(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

/// A text that is a number as a whole, "1.5", "+2e3", independent of the locale. A number beyond the range of
/// a double becomes 0 or infinite.
///
/// @return Possibly infinite or NaN ("inf", "nan"); missing if the text is not a number.
inline std::optional<double> parseNumber(std::string_view text) {
  if (text.starts_with("+-")) return std::nullopt;
  const char* at = text.data();
  const char* const end = at + text.size();
  double value = 0;
  return scanNumber(at, end, value) && at == end ? std::optional(value) : std::nullopt;
}

}  // namespace arete::text
