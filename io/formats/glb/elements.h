// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>

#include "surface/model/attribute.h"

namespace arete {

/// The elements of an accessor, or of a decoded attribute: numbers in memory. All of them are checked to lie
/// in the bytes behind them.
struct GltfElements {
  const char* first = nullptr;
  std::uint64_t count = 0;
  std::uint64_t stride = 0;  ///< bytes from one element to the next; 0: all are the first one
  ScalarType type = ScalarType::float32;
  std::uint8_t components = 1;
  std::uint8_t rows = 1;                   ///< of a matrix, else the components
  std::uint8_t columnStride = 0;           ///< bytes from one column of a matrix to the next
  bool isNormalized = false;               ///< whole numbers stand for fractions of their largest value
  std::shared_ptr<const void> owned = {};  ///< has the bytes, where no buffer has them

  const char* at(std::uint64_t element, std::size_t component) const {
    return first + element * stride + component / rows * columnStride + component % rows * sizeOf(type);
  }
  bool isPacked() const { return rows == components || columnStride == rows * sizeOf(type); }

  /// A number as it is stored.
  double number(std::uint64_t element, std::size_t component) const {
    const char* const from = at(element, component);
    switch (type) {
      case ScalarType::int8:
        return as<std::int8_t>(from);
      case ScalarType::uint8:
        return as<std::uint8_t>(from);
      case ScalarType::int16:
        return as<std::int16_t>(from);
      case ScalarType::uint16:
        return as<std::uint16_t>(from);
      case ScalarType::int32:
        return as<std::int32_t>(from);
      case ScalarType::uint32:
        return as<std::uint32_t>(from);
      case ScalarType::float32:
        return double{as<float>(from)};
      default:
        return as<double>(from);
    }
  }
  /// A number with the fraction taken: c / 127, at least -1, of a normalized signed byte.
  double value(std::uint64_t element, std::size_t component) const {
    const double stored = number(element, component);
    return isNormalized ? std::max(stored / largestOf(type), -1.0) : stored;
  }
  /// An index. Precondition: the type is unsigned.
  std::uint32_t index(std::uint64_t element) const {
    const char* const from = first + element * stride;
    if (type == ScalarType::uint8) return as<std::uint8_t>(from);
    if (type == ScalarType::uint16) return as<std::uint16_t>(from);
    return as<std::uint32_t>(from);
  }

  /// What a normalized number of a type is divided by; 1 for floats.
  static double largestOf(ScalarType type) {
    switch (type) {
      case ScalarType::int8:
        return std::numeric_limits<std::int8_t>::max();
      case ScalarType::uint8:
        return std::numeric_limits<std::uint8_t>::max();
      case ScalarType::int16:
        return std::numeric_limits<std::int16_t>::max();
      case ScalarType::uint16:
        return std::numeric_limits<std::uint16_t>::max();
      case ScalarType::int32:
        return std::numeric_limits<std::int32_t>::max();
      case ScalarType::uint32:
        return std::numeric_limits<std::uint32_t>::max();
      default:
        return 1;
    }
  }

 private:
  template <class T>
  static T as(const char* from) {
    T number;
    std::memcpy(&number, from, sizeof number);
    return number;
  }
};

}  // namespace arete
