// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/glb/base64.h"

#include <cstdint>

namespace arete {

namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t kNoDigit = 0xFF;

std::array<std::uint8_t, 256> valuesOfDigits() {
  std::array<std::uint8_t, 256> values;
  values.fill(kNoDigit);
  for (std::size_t d = 0; d < kDigits.size(); ++d)
    values[static_cast<unsigned char>(kDigits[d])] = static_cast<std::uint8_t>(d);
  return values;
}

void appendGroup(const std::array<unsigned char, 3>& bytes, std::size_t count, std::string& to) {
  const std::uint32_t group = (std::uint32_t{bytes[0]} << 16) | (std::uint32_t{bytes[1]} << 8) | bytes[2];
  for (std::size_t d = 0; d < 4; ++d) to += d <= count ? kDigits[(group >> (18 - 6 * d)) & 63] : '=';
}

}  // namespace

std::optional<std::string> fromBase64(std::string_view text) {
  static const std::array<std::uint8_t, 256> values = valuesOfDigits();
  if (text.ends_with('=') && text.size() % 4 != 0) return std::nullopt;
  for (int padding = 0; padding < 2 && text.ends_with('='); ++padding) text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t group = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::uint8_t value = values[static_cast<unsigned char>(text[i])];
    if (value == kNoDigit) return std::nullopt;
    group = (group << 6) | value;
    if (i % 4 != 0) bytes += static_cast<char>((group >> (6 - 2 * (i % 4))) & 0xFF);
  }
  return bytes;
}

void Base64Writer::add(std::string_view bytes, std::string& to) {
  for (const char byte : bytes) {
    waiting_[count_++] = static_cast<unsigned char>(byte);
    if (count_ < 3) continue;
    appendGroup(waiting_, count_, to);
    waiting_ = {};
    count_ = 0;
  }
}

void Base64Writer::finish(std::string& to) {
  if (count_ > 0) appendGroup(waiting_, count_, to);
  waiting_ = {};
  count_ = 0;
}

}  // namespace arete
