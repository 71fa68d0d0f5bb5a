// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/common/text_numbers.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace arete {
namespace {

bool isTextOfFloat(double number) {
  const auto rounded = static_cast<float>(number);
  if (!std::isfinite(rounded)) return std::isfinite(number) == false;
  // Small whole numbers have the same digits in both types.
  constexpr double kMostExact = 1 << 20;
  if (number == std::trunc(number) && std::abs(number) <= kMostExact) return true;
  char text[32];
  const char* const end = fmt::format_to(text, FMT_COMPILE("{}"), rounded);
  double read = 0;
  return std::from_chars(text, end, read).ec == std::errc{} && read == number;
}

}  // namespace

Attribute attributeOfTextNumbers(std::string name, AttributeMeaning meaning, std::uint8_t components,
                                 std::span<const double> numbers) {
  const bool areFloats = std::ranges::all_of(numbers, isTextOfFloat);
  Attribute attribute{.name = std::move(name),
                      .meaning = meaning,
                      .type = areFloats ? ScalarType::float32 : ScalarType::float64,
                      .components = components};
  attribute.values.resize(numbers.size() * sizeOf(attribute.type));
  if (!areFloats) {
    if (!numbers.empty()) std::memcpy(attribute.values.data(), numbers.data(), attribute.values.size());
    return attribute;
  }
  std::byte* to = attribute.values.data();
  for (const double number : numbers) {
    const auto value = static_cast<float>(number);
    std::memcpy(to, &value, sizeof value);
    to += sizeof value;
  }
  return attribute;
}

double fractionOf(const Attribute& attribute, double number) {
  if (!attribute.isNormalized) return number;
  switch (attribute.type) {
    case ScalarType::int8:
      return std::max(number / std::numeric_limits<std::int8_t>::max(), -1.0);
    case ScalarType::uint8:
      return number / std::numeric_limits<std::uint8_t>::max();
    case ScalarType::int16:
      return std::max(number / std::numeric_limits<std::int16_t>::max(), -1.0);
    case ScalarType::uint16:
      return number / std::numeric_limits<std::uint16_t>::max();
    case ScalarType::int32:
      return std::max(number / std::numeric_limits<std::int32_t>::max(), -1.0);
    case ScalarType::uint32:
      return number / std::numeric_limits<std::uint32_t>::max();
    case ScalarType::float32:
    case ScalarType::float64:
      return number;
  }
  return number;
}

bool hasFloat32Digits(const Attribute& attribute) {
  if (attribute.type != ScalarType::float32 && !(attribute.isNormalized && sizeOf(attribute.type) < 4))
    return false;
  if (!attribute.isFromTop || attribute.components < 2) return true;
  for (std::size_t i = 0; i < attribute.elementCount(); ++i) {
    const double fromBelow = 1 - fractionOf(attribute, attribute.numbers(i)[1]);
    if (double{static_cast<float>(fromBelow)} != fromBelow) return false;
  }
  return true;
}

}  // namespace arete
