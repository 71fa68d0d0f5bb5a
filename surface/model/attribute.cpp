// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/model/attribute.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "surface/model/with_scalar_type.h"

namespace arete {
namespace {

template <class T>
T rounded(double number) {
  if constexpr (std::is_floating_point_v<T>) {
    return static_cast<T>(number);
  } else {
    if (std::isnan(number)) return 0;
    return static_cast<T>(std::clamp(std::round(number), double(std::numeric_limits<T>::min()),
                                     double(std::numeric_limits<T>::max())));
  }
}

}  // namespace

std::size_t sizeOf(ScalarType type) {
  return withScalarType(type, [](auto zero) { return sizeof zero; });
}

std::vector<double> Attribute::numbers(std::size_t i) const {
  std::vector<double> result;
  withScalarType(type, [&](auto zero) {
    const std::span<const std::byte> bytes = element(i);
    for (std::size_t c = 0; c < components; ++c) {
      auto number = zero;
      std::memcpy(&number, bytes.data() + c * sizeof number, sizeof number);
      result.push_back(double(number));
    }
  });
  return result;
}

void Attribute::append(std::span<const double> numbers) {
  assert(numbers.size() == components);
  withScalarType(type, [&](auto zero) {
    for (const double number : numbers) {
      const auto value = rounded<decltype(zero)>(number);
      const auto* const bytes = reinterpret_cast<const std::byte*>(&value);
      values.insert(values.end(), bytes, bytes + sizeof value);
    }
  });
}

Attribute emptyLike(const Attribute& attribute) {
  Attribute empty;
  empty.name = attribute.name;
  empty.meaning = attribute.meaning;
  empty.type = attribute.type;
  empty.components = attribute.components;
  empty.isNormalized = attribute.isNormalized;
  empty.colorSpace = attribute.colorSpace;
  empty.isFromTop = attribute.isFromTop;
  return empty;
}

Status checkAttribute(const Attribute& attribute, std::size_t elements) {
  if (attribute.components == 0)
    return failure(ErrorCode::invalidData, fmt::format("attribute '{}' has no components", attribute.name));
  if (attribute.values.size() != elements * attribute.elementBytes())
    return failure(ErrorCode::invalidData,
                   fmt::format("attribute '{}' has {} bytes for {} elements of {}", attribute.name,
                               attribute.values.size(), elements, attribute.elementBytes()));
  return {};
}

}  // namespace arete
