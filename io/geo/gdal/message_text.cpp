// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/gdal/message_text.h"

#include <algorithm>
#include <string_view>

#include "io/files/text/address_text.h"
#include "io/geo/network/network_path.h"

namespace arete {
namespace {

/// Shorter ones are colours, flags and counts.
constexpr std::size_t kLeastDigits = 7;

bool isHexDigit(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

/// Removes addresses of memory, each with the underscore before it or the comma and blank behind it.
std::string withoutMemory(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = text.substr(i);
    std::size_t end = 2;
    if (rest.starts_with("0x"))
      while (end < rest.size() && isHexDigit(rest[end])) ++end;
    if (end < 2 + kLeastDigits) {
      result += text[i++];
      continue;
    }
    const bool isSuffix = !result.empty() && result.back() == '_';
    if (isSuffix) result.pop_back();
    if (!isSuffix && end < rest.size() && rest[end] == ',') {
      ++end;
      while (end < rest.size() && rest[end] == ' ') ++end;
    }
    i += end;
  }
  return result;
}

}  // namespace

std::string gdalMessageText(const char* message) {
  std::string text = withoutQueries(withoutServing(withoutMemory(message ? message : "")));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 32 || c == 127; }, ' ');
  constexpr std::string_view kNoReason = " Success";
  const auto trim = [&] {
    while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  };
  trim();
  if (text.ends_with(kNoReason)) text.resize(text.size() - kNoReason.size());
  trim();
  return text;
}

}  // namespace arete
