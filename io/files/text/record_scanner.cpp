// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/text/record_scanner.h"

#include <algorithm>

#include "io/files/text_scan.h"

namespace arete {

std::size_t findComment(std::string_view line) {
  std::size_t at = line.find('#');
  const auto isQuoted = [&] {
    return std::count(line.begin(), line.begin() + std::ptrdiff_t(at), '"') % 2 != 0;
  };
  const auto isInWord = [&] {
    const std::string_view behind = line.substr(at + 1, 1);
    return line.substr(0, at).ends_with("1.") && !behind.empty() && text::lowered(behind) >= "a" &&
           text::lowered(behind) <= "z";
  };
  while (at != std::string_view::npos && (isQuoted() || isInWord())) at = line.find('#', at + 1);
  return at;
}

std::size_t QuoteScanner::recordEnd(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inQuotes_) {
      if (c != '"') continue;
      if (i + 1 < text.size() && text[i + 1] == '"') {
        ++i;
      } else {
        inQuotes_ = false;
        isClosed_ = true;
      }
    } else if (c == '\n' || c == '#') {
      return c == '\n' ? i : text.find('\n', i);
    } else if (c == separator_) {
      atFieldStart_ = true;
      isClosed_ = false;
    } else if (c == '"' && atFieldStart_) {
      inQuotes_ = true;
      atFieldStart_ = false;
    } else if (c != ' ' && c != '\t' && c != '\r') {
      atFieldStart_ = false;
      hasTextBehindQuotes_ = hasTextBehindQuotes_ || isClosed_;
    }
  }
  return std::string_view::npos;
}

}  // namespace arete
