// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/text/address_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "io/files/text_scan.h"

namespace arete {
namespace {

constexpr std::string_view kEnds = "\"'<>{}|\\^`";
constexpr std::array<std::string_view, 3> kSchemes = {"http://", "https://", "ftp://"};

bool endsInText(char c) {
  return text::isSpace(c) || kEnds.find(c) != std::string_view::npos;
}

bool endsInName(char c) {
  return c == '}';  // "/vsizip/{/vsicurl/https://...}/a.tif"
}

/// The length of the scheme that begins there; 0 if none does.
std::size_t schemeAt(std::string_view lower, std::size_t at) {
  for (const std::string_view scheme : kSchemes)
    if (lower.substr(at).starts_with(scheme)) return scheme.size();
  return 0;
}

std::optional<int> hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const char lower = static_cast<char>(c | 0x20);
  if (lower >= 'a' && lower <= 'f') return lower - 'a' + 10;
  return std::nullopt;
}

std::string percentDecoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size())
      if (const auto high = hexDigit(text[i + 1]), low = hexDigit(text[i + 2]); high && low) {
        decoded += static_cast<char>(*high * 16 + *low);
        i += 2;
        continue;
      }
    decoded += text[i];
  }
  return decoded;
}

/// How much punctuation ends a word: that of the sentence in which it stands.
std::size_t punctuationAt(std::string_view word) {
  std::size_t end = word.size();
  while (end > 0 && std::string_view(".,;:!)").find(word[end - 1]) != std::string_view::npos) --end;
  return word.size() - end;
}

/// An address that begins with a scheme of that length.
std::string shortened(std::string_view address, std::size_t scheme) {
  const std::size_t punctuation = punctuationAt(address);
  const std::string_view tail = address.substr(address.size() - punctuation);
  address.remove_suffix(punctuation);
  std::string_view rest = address.substr(scheme);
  rest = rest.substr(0, std::min(rest.find_first_of("?#"), rest.size()));
  const std::string_view host = rest.substr(0, std::min(rest.find('/'), rest.size()));
  if (const std::size_t at = host.rfind('@'); at != host.npos) rest.remove_prefix(at + 1);
  std::string text(address.substr(0, scheme));
  return text.append(rest).append(tail);
}

/// "/vsicurl?a=b&url=https%3A%2F%2Fhost%2Fa.tif&c=d".
std::string shortenedOptions(std::string_view name) {
  constexpr std::string_view kUrl = "url=";
  for (std::size_t at = name.find('?'); at != name.npos; at = name.find('&', at + 1)) {
    std::string_view option = name.substr(at + 1);
    option = option.substr(0, std::min(option.find('&'), option.size()));
    if (!text::lowered(option).starts_with(kUrl)) continue;
    return "/vsicurl/" + withoutQueries(percentDecoded(option.substr(kUrl.size())));
  }
  return "/vsicurl/";
}

template <class Ends>
std::string withoutQueriesIn(std::string_view text, const Ends& ends) {
  constexpr std::string_view kOptions = "/vsicurl?";
  const std::string lower = text::lowered(text);
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t scheme = schemeAt(lower, i);
    const bool hasOptions = std::string_view(lower).substr(i).starts_with(kOptions);
    if (scheme == 0 && !hasOptions) {
      result += text[i++];
      continue;
    }
    std::size_t end = i;
    while (end < text.size() && !ends(text[end])) ++end;
    const std::string_view word = text.substr(i, end - i);
    result += hasOptions ? shortenedOptions(word) : shortened(word, scheme);
    i = end;
  }
  return result;
}

}  // namespace

std::string withoutQueries(std::string_view text) {
  return withoutQueriesIn(text, endsInText);
}

std::string nameWithoutQuery(std::string_view name) {
  return withoutQueriesIn(name, endsInName);
}

}  // namespace arete
