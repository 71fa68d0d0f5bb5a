// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

namespace arete {

/// What stands between the fields of a text: a semicolon, comma, tab, vertical bar, or runs of blanks.
inline constexpr char kSpaces = ' ';

bool isBlank(char c);  ///< space, tab, or the carriage return of a line end
/// The text without blanks around it.
std::string_view trimmed(std::string_view text);

/// Takes the next field off the front of `rest`, without blanks and quotes around it. False if none is left.
bool nextField(std::string_view& rest, char separator, std::string_view& field);
std::vector<std::string_view> fieldsOf(std::string_view line, char separator);

/// Finds the separator of a text by its first record: the first of semicolon, comma, tab and vertical bar
/// that occurs in it, else blanks. Commas do not count where all of them are decimal signs: every field
/// between tabs, bars or blanks that has one is a number. A bar does not count if blanks separate numbers.
char separatorOf(std::string_view line);

}  // namespace arete
