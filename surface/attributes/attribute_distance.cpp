// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/attributes/attribute_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "surface/model/labels.h"

namespace arete {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The value that a normalised integer has for 1.
double largest(const Attribute& a) {
  if (isFloat(a.type)) return 1;
  const bool isSigned =
      a.type == ScalarType::int8 || a.type == ScalarType::int16 || a.type == ScalarType::int32;
  return std::exp2(8 * double(sizeOf(a.type)) - (isSigned ? 1 : 0)) - 1;
}

bool isDirection(AttributeMeaning meaning) {
  return meaning == AttributeMeaning::normal || meaning == AttributeMeaning::tangent;
}

/// Of two directions of any length, by the tangent, which is exact for small angles too.
double degreesBetween(std::span<const double> a, std::span<const double> b) {
  const std::array<double, 3> across = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                        a[0] * b[1] - a[1] * b[0]};
  const double along = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  return std::atan2(std::hypot(across[0], across[1], across[2]), along) * 180 / std::numbers::pi;
}

}  // namespace

AttributeDistance::AttributeDistance(const Attribute& attribute, std::array<double, 2> pixels)
    : meaning_(attribute.meaning),
      components_(attribute.components),
      scale_(attribute.components, attribute.isNormalized ? 1 / largest(attribute) : 1.0) {
  isLinear_ = !isLabel(attribute);
  if (meaning_ == AttributeMeaning::color)
    for (double& s : scale_) s = 255 / largest(attribute);
  if (isDirection(meaning_) && components_ < 3) meaning_ = AttributeMeaning::other;
  if (meaning_ != AttributeMeaning::textureCoords) return;
  isInPixels_ = pixels != std::array<double, 2>{1, 1};
  for (std::size_t c = 0; c < std::min<std::size_t>(2, components_); ++c) scale_[c] *= pixels[c];
}

std::string AttributeDistance::unit() const {
  if (!isLinear_) return "";
  if (meaning_ == AttributeMeaning::color) return "255ths";
  if (isDirection(meaning_)) return "degrees";
  return isInPixels_ ? "pixels" : "units";
}

std::vector<double> AttributeDistance::values(const Attribute& attribute, std::size_t element) const {
  std::vector<double> numbers = attribute.numbers(element);
  for (std::size_t c = 0; c < numbers.size(); ++c) numbers[c] *= scale_[c];
  return numbers;
}

std::vector<double> AttributeDistance::drawnValues(const Attribute& attribute, std::size_t element) const {
  std::vector<double> numbers = values(attribute, element);
  if (!isDirection(meaning_)) return numbers;
  const double length = std::hypot(numbers[0], numbers[1], numbers[2]);
  if (length > 0 && std::isfinite(length))
    for (std::size_t c = 0; c < 3; ++c) numbers[c] /= length;
  return numbers;
}

double AttributeDistance::operator()(std::span<const double> a, std::span<const double> b) const {
  if (std::ranges::equal(a, b)) return 0;
  // NaN is the same as NaN: a file that has it keeps it.
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  if (!isLinear_) return std::ranges::equal(a, b, same) ? 0 : kInfinity;
  for (std::size_t c = 0; c < a.size(); ++c)
    if (!std::isfinite(a[c]) || !std::isfinite(b[c])) return std::ranges::equal(a, b, same) ? 0 : kInfinity;
  if (isDirection(meaning_)) {
    if (components_ > 3 && (a[3] < 0) != (b[3] < 0)) return kInfinity;
    const auto isZero = [](std::span<const double> v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; };
    if (isZero(a) || isZero(b)) return isZero(a) && isZero(b) ? 0 : kInfinity;
    return degreesBetween(a, b);
  }
  double most = 0, squares = 0;
  for (std::size_t c = 0; c < a.size(); ++c) {
    most = std::max(most, std::abs(a[c] - b[c]));
    squares += (a[c] - b[c]) * (a[c] - b[c]);
  }
  return meaning_ == AttributeMeaning::color ? most : std::sqrt(squares);
}

}  // namespace arete
