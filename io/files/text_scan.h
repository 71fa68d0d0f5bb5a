// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

namespace arete::text {

/// Functions that the readers of texts and names share. None depends on the locale.

inline bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}
inline bool isSpace(char c) {
  return isBlank(c) || c == '\n';
}

/// Turns A to Z into lower case.
inline std::string lowered(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

/// The last extension of a path, in lower case and without the dot.
inline std::string lowerExtension(std::string_view path) {
  const std::size_t dot = path.find_last_of("./\\");
  if (dot == std::string_view::npos || path[dot] != '.') return {};
  return lowered(path.substr(dot + 1));
}

/// The line of a position in a text, counted from 1. O(distance): for messages only.
inline std::size_t lineOf(const char* begin, const char* at) {
  std::size_t line = 1;
  for (; begin < at; ++begin) line += *begin == '\n';
  return line;
}

/// Reads a number that ends at white space or at `end`, and moves `at` behind it. False if there is no
/// number.
inline bool scanNumber(const char*& at, const char* end, double& value) {
  const char* from = at;
  if (from < end && *from == '+') ++from;
  const auto [behind, error] = std::from_chars(from, end, value);
  if (error == std::errc::result_out_of_range)
    value = std::strtod(std::string(from, behind).c_str(), nullptr);  // rounds to 0 or to infinity
  else if (error != std::errc{})
    return false;
  if (behind < end && !isSpace(*behind)) return false;
  at = behind;
  return true;
}

/// Text of a file for a message: truncated to `longest` bytes, control characters replaced, so that a file
/// cannot send commands to a terminal.
inline std::string printable(std::string_view text, std::size_t longest) {
  std::string result(text.substr(0, longest));
  for (char& c : result)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  return text.size() > longest ? result + "..." : result;
}

/// A token in quotes for a message, truncated and with control characters replaced.
inline std::string quotedToken(std::string_view token) {
  constexpr std::size_t kLongest = 40;
  std::string text = "\"";
  for (const char c : token.substr(0, kLongest)) text += c >= 32 && c < 127 ? c : '?';
  return text + (token.size() > kLongest ? "...\"" : "\"");
}

/// Replaces each run of line breaks, with the blanks around it, by one space.
inline std::string onOneLine(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\n' && text[i] != '\r') {
      result += text[i];
      continue;
    }
    while (!result.empty() && isBlank(result.back())) result.pop_back();
    while (i + 1 < text.size() && isSpace(text[i + 1])) ++i;
    if (!result.empty() && i + 1 < text.size()) result += ' ';
  }
  return result;
}

}  // namespace arete::text
