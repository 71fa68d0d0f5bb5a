// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/stl/facet_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace arete {
namespace {

constexpr std::uint16_t kFlag = 0x8000, kMostCode = 31;
constexpr double kMostByte = 255;

std::uint8_t byteOf(unsigned code) {
  return static_cast<std::uint8_t>((code * 255 + kMostCode / 2) / kMostCode);
}

unsigned bitsAt(std::uint16_t word, int shift) {
  return (static_cast<unsigned>(word) >> shift) & kMostCode;
}

}  // namespace

std::optional<Attribute> facetAttribute(std::string_view header, const std::vector<std::uint16_t>& words) {
  if (std::ranges::all_of(words, [](std::uint16_t w) { return w == 0; })) return std::nullopt;
  constexpr std::string_view kMagics = "COLOR=";
  std::optional<std::array<std::uint8_t, 4>> ofHeader;
  if (const std::size_t at = header.find(kMagics);
      at != std::string_view::npos && at + kMagics.size() + 4 <= header.size()) {
    ofHeader.emplace();
    std::memcpy(ofHeader->data(), header.data() + at + kMagics.size(), 4);
  }
  const bool isClear = ofHeader
                           ? (*ofHeader)[3] == 255
                           : std::ranges::all_of(words, [](std::uint16_t w) { return (w & kFlag) != 0; });
  if (!isClear) {
    Attribute raw{.name = "attribute", .type = ScalarType::uint16};
    raw.values.resize(words.size() * sizeof(std::uint16_t));
    std::memcpy(raw.values.data(), words.data(), raw.values.size());
    return raw;
  }
  Attribute color{.name = std::string(kColorName),
                  .meaning = AttributeMeaning::color,
                  .type = ScalarType::uint8,
                  .components = 3,
                  .isNormalized = true,
                  .colorSpace = ColorSpace::srgb};
  color.values.reserve(3 * words.size());
  const auto add = [&](std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    color.values.insert(color.values.end(), {std::byte{r}, std::byte{g}, std::byte{b}});
  };
  for (const std::uint16_t w : words) {
    if (!ofHeader)
      add(byteOf(bitsAt(w, 10)), byteOf(bitsAt(w, 5)), byteOf(bitsAt(w, 0)));
    else if ((w & kFlag) != 0)
      add((*ofHeader)[0], (*ofHeader)[1], (*ofHeader)[2]);
    else
      add(byteOf(bitsAt(w, 0)), byteOf(bitsAt(w, 5)), byteOf(bitsAt(w, 10)));
  }
  return color;
}

std::uint16_t facetWord(std::span<const double> color, bool& isRounded) {
  std::uint16_t word = kFlag;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto code = static_cast<unsigned>(std::lround(std::clamp(color[i], 0.0, 1.0) * kMostCode));
    isRounded = isRounded || color[i] * kMostByte != byteOf(code);
    word = static_cast<std::uint16_t>(word | (code << (10 - 5 * i)));
  }
  return word;
}

}  // namespace arete
