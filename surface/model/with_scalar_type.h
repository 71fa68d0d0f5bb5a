// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "surface/model/attribute.h"

namespace arete {

/// Calls visit(T()) with the type of an attribute's numbers.
template <class Visit>
decltype(auto) withScalarType(ScalarType type, const Visit& visit) {
  switch (type) {
    case ScalarType::int8:
      return visit(std::int8_t());
    case ScalarType::uint8:
      return visit(std::uint8_t());
    case ScalarType::int16:
      return visit(std::int16_t());
    case ScalarType::uint16:
      return visit(std::uint16_t());
    case ScalarType::int32:
      return visit(std::int32_t());
    case ScalarType::uint32:
      return visit(std::uint32_t());
    case ScalarType::float32:
      return visit(float());
    default:
      return visit(double());
  }
}

}  // namespace arete
