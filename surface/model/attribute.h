// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "engine/base/result.h"

namespace arete {

/// The type of the numbers of an attribute, as the file has them.
enum class ScalarType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t sizeOf(ScalarType type);
constexpr bool isFloat(ScalarType type) {
  return type == ScalarType::float32 || type == ScalarType::float64;
}

/// What the numbers of an attribute mean, which says how they are carried along
/// and written.
enum class AttributeMeaning : std::uint8_t {
  other,          ///< any numbers; integers are labels
  normal,         ///< a direction
  tangent,        ///< a direction, and the sign of the third one
  textureCoords,  ///< a place in a picture; see Attribute::isFromTop
  color,          ///< red, green, blue, perhaps alpha
};

/// How the numbers of a color relate to light.
enum class ColorSpace : std::uint8_t { none, srgb, linear };

/// Names of attributes that have a meaning. Further sets have a number behind the name: "texcoord1".
inline constexpr std::string_view kNormalName = "normal", kTangentName = "tangent",
                                  kTexcoordName = "texcoord", kColorName = "color";

/// Numbers that belong to the elements of a mesh: vertices, wedges or
/// triangles. They are kept as the bytes of the file's own type, so that they
/// go from file to file to the bit.
struct Attribute {
  std::string name;  ///< unique among those of the same elements
  AttributeMeaning meaning = AttributeMeaning::other;
  ScalarType type = ScalarType::float32;
  std::uint8_t components = 1;  ///< of an element
  bool isNormalized = false;    ///< integers stand for fractions of their largest value
  ColorSpace colorSpace = ColorSpace::none;
  /// Of texture coordinates: the second one is counted from the upper side of the picture, as in glTF, not
  /// from the lower one, as in OBJ and PLY.
  bool isFromTop = false;
  std::vector<std::byte> values = {};  ///< element by element, component by component

  std::size_t elementBytes() const { return sizeOf(type) * components; }
  std::size_t elementCount() const { return values.size() / elementBytes(); }
  std::span<const std::byte> element(std::size_t i) const {
    return std::span(values).subspan(i * elementBytes(), elementBytes());
  }
  /// The raw numbers of an element; normalised integers are not divided. Exact for every type.
  std::vector<double> numbers(std::size_t i) const;
  /// Adds an element, each number rounded to the nearest of the type and held
  /// within its range; NaN of an integer type is 0. Precondition:
  /// numbers.size() == components.
  void append(std::span<const double> numbers);
  /// Adds a copy of an element of an attribute of the same type and number of
  /// components.
  void append(std::span<const std::byte> element) {
    values.insert(values.end(), element.begin(), element.end());
  }

  bool operator==(const Attribute&) const = default;
};

/// An attribute of the same kind without elements.
Attribute emptyLike(const Attribute& attribute);

/// Checks that an attribute has whole elements, as many as `elements`. Errors:
/// invalidData.
Status checkAttribute(const Attribute& attribute, std::size_t elements);

}  // namespace arete
