// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/glb/writer/numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include "surface/model/with_scalar_type.h"

namespace arete {
namespace {

template <class T>
double largest() {
  return double{std::numeric_limits<T>::max()};
}

/// A copy without numbers, with room for as many as this has.
Attribute ofType(const Attribute& attribute, ScalarType type) {
  Attribute to = emptyLike(attribute);
  to.type = type;
  to.values.resize(numberCount(attribute) * sizeOf(type));
  return to;
}

}  // namespace

double numberAt(const Attribute& attribute, std::size_t n) {
  return withScalarType(attribute.type, [&](auto number) {
    std::memcpy(&number, attribute.values.data() + n * sizeof number, sizeof number);
    return static_cast<double>(number);
  });
}

void setNumber(Attribute& attribute, std::size_t n, double number) {
  withScalarType(attribute.type, [&](auto zero) {
    using T = decltype(zero);
    T value{};
    if constexpr (std::is_floating_point_v<T>) {
      value =
          static_cast<T>(std::isfinite(number) ? std::clamp(number, -largest<T>(), largest<T>()) : number);
    } else if (!std::isnan(number)) {
      value =
          static_cast<T>(std::clamp(std::round(number), double{std::numeric_limits<T>::min()}, largest<T>()));
    }
    std::memcpy(attribute.values.data() + n * sizeof value, &value, sizeof value);
  });
}

std::size_t numberCount(const Attribute& attribute) {
  return attribute.values.size() / sizeOf(attribute.type);
}

bool makeFloat32(Attribute& attribute) {
  if (attribute.type == ScalarType::float32) return true;
  const double scale =
      !attribute.isNormalized || isFloat(attribute.type)
          ? 1
          : withScalarType(attribute.type, [](auto zero) { return largest<decltype(zero)>(); });
  Attribute to = ofType(attribute, ScalarType::float32);
  to.isNormalized = false;
  bool isExact = true;
  for (std::size_t n = 0; n < numberCount(attribute); ++n) {
    const double number = numberAt(attribute, n);
    const double fraction = scale == 1 ? number : std::max(number / scale, -1.0);
    setNumber(to, n, fraction);
    // A fraction counts as held if the integer comes back.
    const double back = scale == 1 ? numberAt(to, n) : std::max(std::round(numberAt(to, n) * scale), -scale);
    isExact = isExact && (back == (scale == 1 ? number : std::max(number, -scale)) || std::isnan(number));
  }
  attribute = std::move(to);
  return isExact;
}

bool makeSmaller(Attribute& attribute) {
  double low = 0, high = 0;
  bool areFloats = true;
  for (std::size_t n = 0; n < numberCount(attribute); ++n) {
    const double number = numberAt(attribute, n);
    low = std::min(low, number);
    high = std::max(high, number);
    areFloats = areFloats && double{static_cast<float>(number)} == number;
  }
  ScalarType type = ScalarType::float32;
  if (low >= 0 && high <= largest<std::uint16_t>())
    type = ScalarType::uint16;
  else if (low >= -largest<std::int16_t>() - 1 && high <= largest<std::int16_t>())
    type = ScalarType::int16;
  else if (!areFloats)
    return false;
  Attribute to = ofType(attribute, type);
  for (std::size_t n = 0; n < numberCount(attribute); ++n) setNumber(to, n, numberAt(attribute, n));
  attribute = std::move(to);
  return true;
}

std::size_t makeFinite(Attribute& attribute) {
  std::size_t count = 0;
  if (!isFloat(attribute.type)) return count;
  for (std::size_t n = 0; n < numberCount(attribute); ++n)
    if (!std::isfinite(numberAt(attribute, n))) {
      setNumber(attribute, n, 0);
      ++count;
    }
  return count;
}

}  // namespace arete
