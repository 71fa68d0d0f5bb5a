// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/common/colors.h"

#include <algorithm>
#include <cmath>

namespace arete {
namespace {

constexpr std::size_t kAlpha = 3;

double largestOf(ScalarType type) {
  switch (type) {
    case ScalarType::int8:
      return 127;
    case ScalarType::uint8:
      return 255;
    case ScalarType::int16:
      return 32767;
    case ScalarType::uint16:
      return 65535;
    case ScalarType::int32:
      return 2147483647;
    case ScalarType::uint32:
      return 4294967295;
    default:
      return 1;
  }
}

double held(double fraction) {
  return fraction > 0 ? std::min(fraction, 1.0) : 0;  // NaN: 0
}

Attribute colorsOf(const Attribute& like, ScalarType type, ColorSpace space) {
  Attribute to = emptyLike(like);
  to.type = type;
  to.isNormalized = !isFloat(type);
  to.colorSpace = space;
  to.values.reserve(like.elementCount() * to.elementBytes());
  return to;
}

Attribute toLinear(const Attribute& color, ScalarType type) {
  Attribute to = colorsOf(color, type, ColorSpace::linear);
  const double scale = largestOf(type);
  for (std::size_t i = 0; i < color.elementCount(); ++i) {
    std::vector<double> numbers = colorFractions(color, i);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const double fraction = held(numbers[k]);
      const bool isLinear = k == kAlpha || color.colorSpace == ColorSpace::linear;
      numbers[k] = scale * (isLinear ? fraction : linearOfSrgb(fraction));
    }
    to.append(numbers);
  }
  return to;
}

}  // namespace

double linearOfSrgb(double encoded) {
  const double size = std::abs(encoded);
  return std::copysign(size <= 0.04045 ? size / 12.92 : std::pow((size + 0.055) / 1.055, 2.4), encoded);
}

double srgbOfLinear(double linear) {
  const double size = std::abs(linear);
  return std::copysign(size <= 0.0031308 ? size * 12.92 : 1.055 * std::pow(size, 1 / 2.4) - 0.055, linear);
}

std::vector<double> colorFractions(const Attribute& color, std::size_t element) {
  std::vector<double> numbers = color.numbers(element);
  if (!isFloat(color.type))
    for (double& number : numbers) number = std::max(number / largestOf(color.type), -1.0);
  return numbers;
}

Attribute toLinear16(const Attribute& color) {
  return toLinear(color, ScalarType::uint16);
}

Attribute toLinear32(const Attribute& color) {
  return toLinear(color, ScalarType::float32);
}

Attribute toSrgb8(const Attribute& color, bool& isRounded) {
  Attribute to = colorsOf(color, ScalarType::uint8, ColorSpace::srgb);
  const bool isLinear = color.colorSpace == ColorSpace::linear;
  // A hair more than half a step, for the last bit of the functions.
  constexpr double kHalfStep = 0.5 / 65535 * (1 + 1e-6);
  for (std::size_t i = 0; i < color.elementCount(); ++i) {
    std::vector<double> numbers = colorFractions(color, i);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const bool isConverted = isLinear && k != kAlpha;
      const double fraction = held(numbers[k]);
      const double code = std::round(255 * (isConverted ? srgbOfLinear(fraction) : fraction));
      const double back = isConverted ? linearOfSrgb(code / 255) : code / 255;
      if (!(std::abs(back - numbers[k]) <= kHalfStep)) isRounded = true;
      numbers[k] = code;
    }
    to.append(numbers);
  }
  return to;
}

}  // namespace arete
