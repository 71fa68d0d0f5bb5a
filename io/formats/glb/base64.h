// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace arete {

/// @return The bytes of a text in base 64 (RFC 4648, section 4), with its padding or without; nothing if it
/// is not. O(size).
std::optional<std::string> fromBase64(std::string_view text);

/// Writes bytes in base 64, part by part.
class Base64Writer {
 public:
  /// Appends what the bytes make of whole groups of three; up to two bytes wait.
  void add(std::string_view bytes, std::string& to);
  /// Appends the last group, padded.
  void finish(std::string& to);

 private:
  std::array<unsigned char, 3> waiting_{};
  std::size_t count_ = 0;
};

}  // namespace arete
