// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string_view>

namespace arete {

/// The start of the comment of a record, or npos. In quotes '#' is text, and in "1.#QNAN" and "1.#INF", as
/// older C libraries write what is no number.
std::size_t findComment(std::string_view line);

/// Scans a record for the line breaks that its quoted texts contain. A quote opens a text only at the start
/// of a field; elsewhere it is a character.
class QuoteScanner {
 public:
  explicit QuoteScanner(char separator) : separator_(separator) {}

  /// The end of the record at the start of `text`: the first line break outside quotes, or npos.
  std::size_t recordEnd(std::string_view text);
  bool isInQuotes() const { return inQuotes_; }
  /// A quoted text ends before the end of its field, so its quotes may not be meant as such.
  bool hasTextBehindQuotes() const { return hasTextBehindQuotes_; }

 private:
  char separator_;
  bool inQuotes_ = false, atFieldStart_ = true, isClosed_ = false, hasTextBehindQuotes_ = false;
};

}  // namespace arete
