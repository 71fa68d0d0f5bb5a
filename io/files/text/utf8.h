// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace arete::text {

/// Whether bytes are UTF-8: no overlong form, no surrogate, nothing beyond U+10FFFF. O(size).
bool isUtf8(std::string_view bytes);

/// The bytes as UTF-8: as they are where they are UTF-8, else each byte as the character of Latin-1
/// (ISO 8859-1), which old programs write names in. O(size).
std::string asUtf8(std::string_view bytes);

/// The same for a text of JSON: each string in it that is not UTF-8 is Latin-1. O(size).
std::string jsonAsUtf8(std::string_view text);

}  // namespace arete::text
