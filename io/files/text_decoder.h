// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace arete {

/// Turns the bytes of a text file into UTF-8 with line feeds, part by part. The first part decides: UTF-16 by
/// its byte order mark, or by every other byte being 0 where there is none; carriage returns as line ends if
/// there is no line feed. Anything else passes unchanged, without its UTF-8 byte order mark.
class TextDecoder {
 public:
  /// True if decode() changes a text that begins like this. O(size).
  static bool isNeededFor(std::string_view first);

  /// Appends the text of the next bytes. A half of a code unit, or of a surrogate pair, waits for the next
  /// part. Invalid pairs become U+FFFD. O(size).
  void decode(std::string_view bytes, std::string& to);

  /// Appends what an incomplete last code unit stands for: U+FFFD.
  void finish(std::string& to);

 private:
  enum class Encoding { utf8, utf16LittleEndian, utf16BigEndian };

  void decodeUtf16(std::string_view bytes, std::string& to);

  bool hasBegun_ = false, linesEndInReturns_ = false;
  Encoding encoding_ = Encoding::utf8;
  std::string waiting_;         // bytes of an incomplete code unit
  unsigned highSurrogate_ = 0;  // waiting for its other half
};

}  // namespace arete
