// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/text/utf8.h"

#include <algorithm>
#include <cstddef>

namespace arete::text {
namespace {

unsigned byteAt(std::string_view bytes, std::size_t i) {
  return static_cast<unsigned char>(bytes[i]);
}

/// The length of the character that begins at i; 0: none does.
std::size_t characterAt(std::string_view bytes, std::size_t i) {
  const unsigned first = byteAt(bytes, i);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xC2 && first <= 0xDF ? 2 : first >= 0xE0 && first <= 0xEF ? 3 : 4;
  if (first < 0xC2 || first > 0xF4 || bytes.size() - i < length) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byteAt(bytes, i + k) & 0xC0) != 0x80) return 0;
  const unsigned second = byteAt(bytes, i + 1);
  const bool isWrong = (first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
                       (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F);
  return isWrong ? 0 : length;
}

void appendLatin1(std::string& to, std::string_view bytes) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const unsigned c = byteAt(bytes, i);
    if (c < 0x80) {
      to += static_cast<char>(c);
    } else {
      to += static_cast<char>(0xC0 | (c >> 6));
      to += static_cast<char>(0x80 | (c & 0x3F));
    }
  }
}

}  // namespace

bool isUtf8(std::string_view bytes) {
  for (std::size_t i = 0; i < bytes.size();) {
    const std::size_t length = characterAt(bytes, i);
    if (length == 0) return false;
    i += length;
  }
  return true;
}

std::string asUtf8(std::string_view bytes) {
  if (isUtf8(bytes)) return std::string(bytes);
  std::string text;
  appendLatin1(text, bytes);
  return text;
}

std::string jsonAsUtf8(std::string_view text) {
  if (isUtf8(text)) return std::string(text);
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    // Up to the next string, then the string with its quotes.
    const std::size_t begin = std::min(text.find('"', at), text.size());
    result += asUtf8(text.substr(at, begin - at));
    std::size_t end = begin;
    for (++end; end < text.size() && text[end] != '"'; ++end)
      if (text[end] == '\\') ++end;
    end = std::min(end + 1, text.size());
    if (begin < text.size()) result += asUtf8(text.substr(begin, end - begin));
    at = std::max(end, begin);
    if (begin == text.size()) break;
  }
  return result;
}

}  // namespace arete::text
