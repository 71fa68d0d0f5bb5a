// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/off/keyword.h"

#include <fmt/format.h>

#include "io/files/text_scan.h"

namespace arete {

Result<OffKeyword> offKeywordOf(std::string_view word) {
  const auto unknown = [] { return failure(ErrorCode::corrupt, "is not the first line of an OFF", {}); };
  const std::string lower = text::lowered(word);
  const std::size_t off = lower.find("off");
  if (off == std::string::npos) return unknown();
  const std::string_view before = word.substr(0, off);
  // A small n is a number of coordinates, unless all letters are small.
  if (before.find('4') != std::string_view::npos ||
      (before.find('n') != std::string_view::npos && word[off] == 'O'))
    return failure(ErrorCode::unsupported,
                   fmt::format("is of the kind {}, whose vertices do not have three coordinates",
                               text::quotedToken(word)),
                   {});
  OffKeyword keyword;
  keyword.behind = word.substr(off + 3);
  for (std::string_view rest = std::string_view(lower).substr(0, off); !rest.empty();) {
    const bool isTexture = rest.starts_with("st");
    bool& has = isTexture             ? keyword.hasTexcoords
                : rest.front() == 'c' ? keyword.hasColors
                                      : keyword.hasNormals;
    if (has || (!isTexture && rest.front() != 'c' && rest.front() != 'n')) return unknown();
    has = true;
    if (keyword.hasNormals && !keyword.hasColors) keyword.namesNormalsFirst = true;
    rest.remove_prefix(isTexture ? 2 : 1);
  }
  return keyword;
}

}  // namespace arete
