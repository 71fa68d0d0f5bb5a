// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/glb/writer/packed_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "io/formats/glb/writer/buffer_plan.h"
#include "io/formats/glb/packing/meshopt_streams.h"
#include "io/formats/glb/writer/numbers.h"
#include "io/formats/glb/writer/parts.h"

namespace arete {
namespace {

constexpr int kTextureBits = 12, kMantissaBits = 23;  // of a signed mantissa of 24

PackedValues emptyLike(const GltfValues& from, std::size_t components) {
  PackedValues to;
  to.semantic = from.semantic;
  to.name = from.name;
  to.type = gltfTypeOf(components);
  return to;
}

/// Directions of unit length.
PackedValues directions(const GltfValues& from, std::vector<std::string>& lost) {
  const std::size_t components = from.values.components;
  PackedValues to = emptyLike(from, components);
  std::vector<std::array<float, 4>> vectors(from.values.elementCount());
  for (std::size_t i = 0; i < vectors.size(); ++i)
    for (std::size_t k = 0; k < components; ++k)
      vectors[i][k] = static_cast<float>(numberAt(from.values, i * components + k));
  to.component = GltfCode::kByte;
  to.isNormalized = true;
  to.filter = "OCTAHEDRAL";
  to.stride = 4;
  to.bytes = encodeOctahedral(vectors);
  lost.push_back(from.semantic == "NORMAL" ? "normals finer than 8 bits a component"
                                           : "tangents finer than 8 bits a component");
  return to;
}

/// Whole multiples of one power of two: 24 bits for the multiple, and 8 that are alike for all.
PackedValues textureCoords(const GltfValues& from, std::vector<std::string>& lost) {
  PackedValues to = emptyLike(from, from.values.components);
  const std::size_t count = numberCount(from.values);
  double largest = 0;
  for (std::size_t n = 0; n < count; ++n) largest = std::max(largest, std::abs(numberAt(from.values, n)));
  int exponent = -kTextureBits;
  while (std::round(std::ldexp(largest, -exponent)) >= 1 << kMantissaBits) ++exponent;
  to.component = GltfCode::kFloat;
  to.filter = "EXPONENTIAL";
  to.stride = from.values.components * sizeof(std::uint32_t);
  to.bytes.resize(count * sizeof(std::uint32_t));
  bool isRounded = false;
  for (std::size_t n = 0; n < count; ++n) {
    const double number = numberAt(from.values, n), steps = std::round(std::ldexp(number, -exponent));
    isRounded = isRounded || std::ldexp(steps, exponent) != number;
    const auto mantissa = static_cast<std::uint32_t>(static_cast<std::int32_t>(steps)) & 0xFFFFFFU;
    const std::uint32_t bits = mantissa | static_cast<std::uint32_t>(exponent) << 24U;
    std::memcpy(to.bytes.data() + n * sizeof bits, &bits, sizeof bits);
  }
  if (isRounded)
    lost.push_back(fmt::format("texture coordinates finer than {:.2g}", std::ldexp(1.0, exponent - 1)));
  return to;
}

PackedValues colors(const GltfValues& from, std::vector<std::string>& lost) {
  constexpr double kMost = 255;
  const std::size_t components = from.values.components;
  PackedValues to = emptyLike(from, components);
  to.component = GltfCode::kUnsignedByte;
  to.isNormalized = true;
  to.stride = 4;
  to.bytes.assign(from.values.elementCount() * to.stride, '\0');
  const double unit = from.values.type == ScalarType::uint16 ? 65535 : 1;
  bool isRounded = false;
  for (std::size_t i = 0; i < from.values.elementCount(); ++i)
    for (std::size_t k = 0; k < components; ++k) {
      const double fraction = std::clamp(numberAt(from.values, i * components + k) / unit, 0.0, 1.0);
      const double rounded = std::round(fraction * kMost);
      isRounded = isRounded || std::abs(rounded - fraction * kMost) > 1e-4;
      to.bytes[i * to.stride + k] = static_cast<char>(static_cast<unsigned char>(rounded));
    }
  if (isRounded) lost.emplace_back("colours finer than 8 linear bits");
  return to;
}

PackedValues asTheyAre(const GltfValues& from) {
  PackedValues to = emptyLike(from, from.values.components);
  to.component = gltfComponentOf(from.values.type);
  to.isNormalized = from.values.isNormalized && !isFloat(from.values.type);
  const std::size_t bytes = from.values.elementBytes();
  to.stride = paddedToFour(bytes);
  to.bytes.assign(from.values.elementCount() * to.stride, '\0');
  for (std::size_t i = 0; i < from.values.elementCount(); ++i)
    std::memcpy(to.bytes.data() + i * to.stride, from.values.values.data() + i * bytes, bytes);
  return to;
}

}  // namespace

PackedValues packedValues(const GltfValues& values, std::vector<std::string>& lost) {
  const ScalarType type = values.values.type;
  const bool isDirection = values.semantic == "NORMAL" || values.semantic == "TANGENT";
  if (isDirection && isFloat(type)) return directions(values, lost);
  if (values.semantic.starts_with("TEXCOORD_") && isFloat(type)) return textureCoords(values, lost);
  if (values.semantic.starts_with("COLOR_") && type != ScalarType::uint8) return colors(values, lost);
  return asTheyAre(values);
}

}  // namespace arete
