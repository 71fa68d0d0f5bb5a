// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/obj/vertices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "engine/base/counted.h"
#include "io/formats/common/colors.h"
#include "io/formats/common/text_numbers.h"

namespace arete {
namespace {

constexpr double kMostByte = 255;

const std::array<double, 256>& colorTable() {
  static const std::array<double, 256> table = [] {
    std::array<double, 256> numbers{};
    for (std::size_t code = 0; code < numbers.size(); ++code) {
      const std::string text = fmt::format("{}", static_cast<float>(static_cast<double>(code) / kMostByte));
      std::from_chars(text.data(), text.data() + text.size(), numbers[code]);
    }
    return numbers;
  }();
  return table;
}

/// The byte that a number stands for, exactly.
std::optional<std::uint8_t> codeOf(double number) {
  if (!(number >= 0 && number <= 1)) return std::nullopt;
  const auto code = static_cast<std::uint8_t>(std::lround(number * kMostByte));
  return colorTable()[code] == number ? std::optional(code) : std::nullopt;
}

}  // namespace

double objAlphaOf(const Attribute& color, double number) {
  Attribute whole{.name = {}, .type = color.type, .isNormalized = true};
  return fractionOf(whole, number);
}

/// A byte of sRGB is written by a table, so that reading it gives the byte again.
ObjColorNumber objColorNumber(const Attribute& color, double number) {
  const double fraction = objAlphaOf(color, number);
  if (color.colorSpace != ColorSpace::linear) {
    if (color.type == ScalarType::uint8) return {colorTable()[static_cast<std::uint8_t>(number)], false};
    return {fraction, color.type != ScalarType::float64};
  }
  const double srgb = srgbOfLinear(fraction);
  if (!isFloat(color.type) && srgb >= 0 && srgb <= 1) {
    const auto code = static_cast<std::uint8_t>(std::lround(srgb * kMostByte));
    const double step = color.type == ScalarType::uint8 ? 0.5 / kMostByte : 0.5 / 65535;
    if (std::abs(linearOfSrgb(code / kMostByte) - fraction) <= step) return {colorTable()[code], false};
  }
  return {srgb, color.type != ScalarType::float64};
}

// A vertex may have one number, a weight, or three or four, a colour. Vertices before the first colour are
// filled in with white.
void ObjVertexExtras::add(std::size_t vertex, std::span<const double> numbers) {
  const bool isColor = (numbers.size() == 3 || numbers.size() == 4) &&
                       std::ranges::all_of(numbers, [](double n) { return std::isfinite(n); });
  if (!isColor) {
    if (numbers.size() == 1)
      weights_ += numbers[0] != 1;
    else if (!numbers.empty())
      ++odd_;
    if (colored_ > 0) colors_.insert(colors_.end(), 4, 1.0);
    return;
  }
  colors_.resize(4 * vertex, 1.0);
  ++colored_;
  hasAlpha_ = hasAlpha_ || numbers.size() == 4;
  for (std::size_t i = 0; i < 4; ++i) colors_.push_back(i < numbers.size() ? numbers[i] : 1);
}

void ObjVertexExtras::finish(MeshFile& file) const {
  const auto left = [&](std::uint64_t count, const char* what) {
    if (count > 0)
      file.warnings.push_back(
          {WarningCode::omitted, fmt::format("{} of {} left out", what,
                                             count == 1 ? std::string("one of its vertices are")
                                                        : fmt::format("{} of its vertices are", count))});
  };
  left(weights_, "the weights");
  left(odd_, "numbers behind the coordinates");
  if (colored_ == 0) return;
  const std::size_t vertices = file.mesh.positions.size();
  if (colored_ < vertices)
    file.warnings.push_back(
        {WarningCode::completed, fmt::format("{} of its {} vertices {} a colour; the others are white",
                                             colored_, vertices, agreeing(colored_, "has", "have"))});
  const std::uint8_t components = hasAlpha_ ? 4 : 3;
  std::vector<double> numbers;
  numbers.reserve(components * vertices);
  for (std::size_t v = 0; v < vertices; ++v)
    numbers.insert(numbers.end(), colors_.begin() + std::ptrdiff_t(4 * v),
                   colors_.begin() + std::ptrdiff_t(4 * v + components));
  // Some programs write bytes as they are. White, which was given to vertices without a colour, is 1 then.
  const bool areBytes =
      colored_ == vertices &&
      std::ranges::all_of(numbers, [](double n) { return n >= 0 && n <= kMostByte && n == std::trunc(n); }) &&
      std::ranges::any_of(numbers, [](double n) { return n > 1; });
  if (areBytes || std::ranges::all_of(numbers, [](double n) { return codeOf(n).has_value(); })) {
    Attribute bytes{.name = std::string(kColorName),
                    .meaning = AttributeMeaning::color,
                    .type = ScalarType::uint8,
                    .components = components,
                    .isNormalized = true,
                    .colorSpace = ColorSpace::srgb};
    bytes.values.reserve(numbers.size());
    for (const double n : numbers)
      bytes.values.push_back(static_cast<std::byte>(areBytes ? static_cast<std::uint8_t>(n) : *codeOf(n)));
    file.mesh.vertexAttributes.push_back(std::move(bytes));
    return;
  }
  Attribute color =
      attributeOfTextNumbers(std::string(kColorName), AttributeMeaning::color, components, numbers);
  color.colorSpace = ColorSpace::srgb;
  file.mesh.vertexAttributes.push_back(std::move(color));
}

}  // namespace arete
