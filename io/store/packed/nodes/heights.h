// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "engine/mt/vertex_arrays.h"
#include "io/store/entropy/numbers.h"
#include "io/store/entropy/ordinals.h"

namespace arete::packed {

/// Heights as differences of integers from what was predicted.

/// The nearest whole number, halves upwards. Precondition: below 2^62 in magnitude.
inline std::int64_t nearest(double x) {
  const double shifted = x + 0.5;
  const auto whole = static_cast<std::int64_t>(shifted);
  return whole - (static_cast<double>(whole) > shifted ? 1 : 0);
}

/// The i-th raw height of an array of this type.
inline double rawHeight(HeightEncoding::Type type, const std::byte* heights, std::size_t i) {
  if (type == HeightEncoding::Type::int16) {
    std::int16_t value;
    std::memcpy(&value, heights + 2 * i, sizeof value);
    return value;
  }
  if (type == HeightEncoding::Type::float32) {
    float value;
    std::memcpy(&value, heights + 4 * i, sizeof value);
    return static_cast<double>(value);
  }
  double value;
  std::memcpy(&value, heights + 8 * i, sizeof value);
  return value;
}

/// A raw height less its prediction, in steps of its type: whole numbers, or ordinals of its floating-point
/// type.
inline std::int64_t heightResidual(HeightEncoding::Type type, double raw, double predicted) {
  if (type == HeightEncoding::Type::int16) return static_cast<std::int64_t>(raw) - nearest(predicted);
  if (type == HeightEncoding::Type::float32)
    return static_cast<std::int32_t>(ordinal(static_cast<float>(raw)) -
                                     ordinal(static_cast<float>(predicted)));
  return static_cast<std::int64_t>(ordinal(raw) - ordinal(predicted));
}
/// Writes the i-th raw height, which differs from its prediction by the residual.
/// @return the height; infinity if no int16 has the value, not finite if the floating-point number is not
inline double putHeight(HeightEncoding::Type type, std::byte* heights, std::size_t i, double predicted,
                        std::int64_t residual) {
  if (type == HeightEncoding::Type::int16) {
    const std::int64_t wide = static_cast<std::int64_t>(static_cast<std::uint64_t>(nearest(predicted)) +
                                                        static_cast<std::uint64_t>(residual));
    const std::int16_t value = static_cast<std::int16_t>(wide);
    std::memcpy(heights + 2 * i, &value, sizeof value);
    return value == wide ? value : HUGE_VAL;
  }
  if (type == HeightEncoding::Type::float32) {
    const float value = fromOrdinal(static_cast<std::uint32_t>(ordinal(static_cast<float>(predicted)) +
                                                               static_cast<std::uint32_t>(residual)));
    std::memcpy(heights + 4 * i, &value, sizeof value);
    return static_cast<double>(value);
  }
  const double value = fromOrdinal(ordinal(predicted) + static_cast<std::uint64_t>(residual));
  std::memcpy(heights + 8 * i, &value, sizeof value);
  return value;
}

}  // namespace arete::packed
