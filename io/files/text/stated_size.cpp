// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/text/stated_size.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "engine/base/caught_failure.h"
#include "io/files/number_text.h"

namespace arete {

Result<StatedSize> parseStatedSize(std::string_view text, const std::string& culprit,
                                   const DataUnit* unit) try {
  StatedSize size{.text = {}, .isShare = false};
  for (const char c : text)
    if (c != ' ') size.text += c;
  std::string_view number = size.text;
  size.isShare = number.ends_with('%');
  if (size.isShare) number.remove_suffix(1);
  std::optional<double> value = text::parseNumber(number);
  if (unit && !value && !size.isShare && !number.empty()) {
    ARETE_TRY(const StatedLength length, parseLength(number, culprit));
    ARETE_TRY(value, inDataUnit(length, *unit, fmt::format("{} {}", culprit, size.text)));
    size.hasUnit = true;
  }
  if (!value || std::isnan(*value))
    return failure(ErrorCode::usage, fmt::format("'{}' is not a number", size.text), culprit);
  if (*value < 0) return failure(ErrorCode::usage, fmt::format("{} is below zero", size.text), culprit);
  if (size.isShare && !std::isfinite(*value))
    return failure(ErrorCode::usage, fmt::format("{} is no share", size.text), culprit);
  size.number = *value;
  return size;
} catch (...) {
  return caughtFailure(culprit);
}

Result<std::vector<StatedSize>> parseStatedSizes(std::string_view text, const std::string& culprit,
                                                 const DataUnit* unit) try {
  std::vector<StatedSize> sizes;
  while (true) {
    const std::size_t comma = text.find(',');
    ARETE_TRY(StatedSize size, parseStatedSize(text.substr(0, comma), culprit, unit));
    sizes.push_back(std::move(size));
    if (comma == text.npos) return sizes;
    text.remove_prefix(comma + 1);
  }
} catch (...) {
  return caughtFailure(culprit);
}

}  // namespace arete
