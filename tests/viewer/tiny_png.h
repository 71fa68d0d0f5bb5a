// SPDX-License-Identifier: GPL-3.0-or-later
//
// PNG files of a few pixels, written without compression.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace arete::test {

/// Row by row from the top: red, green, blue and alpha.
inline std::vector<std::byte> tinyPng(std::uint32_t width, const std::vector<std::array<int, 4>>& pixels) {
  const auto number = [](std::uint32_t n) {
    return std::string{char(n >> 24), char(n >> 16), char(n >> 8), char(n)};
  };
  const auto chunk = [&](const std::string& name, const std::string& data) {
    std::uint32_t crc = 0xFFFFFFFF;
    for (const char c : name + data) {
      crc ^= std::uint8_t(c);
      for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xEDB88320u : 0u);
    }
    return number(std::uint32_t(data.size())) + name + data + number(~crc);
  };
  const auto height = std::uint32_t(pixels.size()) / width;
  std::string rows;
  for (std::uint32_t i = 0; i < pixels.size(); ++i) {
    if (i % width == 0) rows += '\0';  // no filter
    for (const int c : pixels[i]) rows += char(c);
  }
  std::uint32_t low = 1, high = 0;  // Adler's checksum
  for (const char c : rows) {
    low = (low + std::uint8_t(c)) % 65521;
    high = (high + low) % 65521;
  }
  const auto size = std::uint16_t(rows.size());
  // One block that is not compressed.
  const std::string deflated = std::string("\x78\x01\x01", 3) + char(size & 255) + char(size >> 8) +
                               char(~size & 255) + char(std::uint16_t(~size) >> 8) + rows +
                               number(high << 16 | low);
  const std::string file = "\x89PNG\r\n\x1a\n" +
                           chunk("IHDR", number(width) + number(height) + std::string("\x08\x06\0\0\0", 5)) +
                           chunk("IDAT", deflated) + chunk("IEND", "");
  std::vector<std::byte> bytes;
  for (const char c : file) bytes.push_back(std::byte(c));
  return bytes;
}

}  // namespace arete::test
