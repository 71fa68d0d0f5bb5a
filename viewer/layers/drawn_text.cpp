// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/layers/drawn_text.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace arete {
namespace {

struct CodeRange {
  std::uint32_t first, last;
};

/// Hebrew to Myanmar, Hangul to Cherokee, Khmer to Vedic signs, East Asia, private letters and other planes.
constexpr std::array<CodeRange, 8> kNotDrawn = {{{0x0590, 0x109F},
                                                 {0x1100, 0x13FF},
                                                 {0x1780, 0x1CFF},
                                                 {0x2E80, 0xA4CF},
                                                 {0xA800, 0xD7FF},
                                                 {0xE000, 0xFAFF},
                                                 {0xFB1D, 0xFDFF},
                                                 {0x20000, 0x10FFFF}}};

}  // namespace

bool isDrawnAsWritten(std::string_view utf8) {
  for (std::size_t i = 0; i < utf8.size();) {
    const auto lead = static_cast<unsigned char>(utf8[i]);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    std::uint32_t code = length == 1 ? lead : lead & (0xFFu >> (length + 1));
    for (std::size_t k = 1; k < length && i + k < utf8.size(); ++k)
      code = code << 6 | (static_cast<unsigned char>(utf8[i + k]) & 0x3Fu);
    if (std::ranges::any_of(kNotDrawn, [&](const CodeRange& r) { return code >= r.first && code <= r.last; }))
      return false;
    i += length;
  }
  return true;
}

}  // namespace arete
