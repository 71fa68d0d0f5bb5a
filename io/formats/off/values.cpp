// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/off/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/counted.h"
#include "io/formats/common/text_numbers.h"

namespace arete {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

bool isByte(double value) {
  return value >= 0 && value <= 255 && value == std::floor(value);
}

bool isUnit(std::span<const OffNumber> vector) {
  double square = 0;
  for (const OffNumber& number : vector) square += number.value * number.value;
  return std::abs(square - 1) < 0.02;
}

}  // namespace

void OffColors::add(std::size_t element, std::span<const OffNumber> numbers) {
  values_.resize(4 * element, kNone);
  for (std::size_t i = 0; i < 4; ++i) values_.push_back(i < numbers.size() ? numbers[i].value : kNone);
  for (const OffNumber& number : numbers) hasFloats_ = hasFloats_ || number.isFloat;
  hasAlpha_ = hasAlpha_ || numbers.size() > 3;
  ++count_;
}

// Colours are bytes or fractions. In a file of Arete the form of the numbers decides; in others whole numbers
// up to 255 are bytes if one of them is above 1 or all are 0. Elements without a colour are white and opaque.
Attribute OffColors::attribute(std::size_t elements, bool isExact) const {
  const std::uint8_t components = hasAlpha_ ? 4 : 3;
  double largest = 0;
  bool areBytes = true;
  for (const double value : values_) {
    if (std::isnan(value)) continue;
    largest = std::max(largest, value);
    areBytes = areBytes && isByte(value);
  }
  areBytes = areBytes && (isExact ? !hasFloats_ : largest > 1 || largest == 0);
  std::vector<double> values;
  values.reserve(elements * components);
  for (std::size_t i = 0; i < elements; ++i)
    for (std::size_t c = 0; c < components; ++c) {
      const double value = 4 * i < values_.size() ? values_[4 * i + c] : kNone;
      values.push_back(std::isnan(value) ? (areBytes ? 255 : 1) : value);
    }
  Attribute attribute;
  if (areBytes) {
    attribute = {.name = std::string(kColorName),
                 .meaning = AttributeMeaning::color,
                 .type = ScalarType::uint8,
                 .components = components,
                 .isNormalized = true};
    for (std::size_t i = 0; i < values.size(); i += components)
      attribute.append(std::span(&values[i], components));
  } else {
    attribute = attributeOfTextNumbers(std::string(kColorName), AttributeMeaning::color, components, values);
  }
  attribute.colorSpace = ColorSpace::srgb;
  return attribute;
}

/// A vertex has as many numbers as the keyword announces; one with fewer gets zeros and is counted. Numbers
/// without an announcement may be a colour, which other programs write so.
void OffVertices::add(std::span<const OffNumber> numbers) {
  const std::size_t vertex = vertices_++;
  const std::size_t normals = keyword_.hasNormals ? 3 : 0, texcoords = keyword_.hasTexcoords ? 2 : 0;
  if (keyword_.values() == 0) {
    if (numbers.size() == 3 || numbers.size() == 4) {
      const bool areBytes = std::ranges::all_of(numbers, [](const OffNumber& n) { return isByte(n.value); });
      if (areBytes) unannounced_.add(vertex, numbers);
    }
    surplus_ += numbers.empty() ? 0 : 1;
    return;
  }
  const std::size_t rest = numbers.size() - std::min(numbers.size(), normals + texcoords);
  const bool fits =
      numbers.size() >= normals + texcoords && (keyword_.hasColors ? rest == 3 || rest == 4 : true);
  const std::size_t colors = fits && keyword_.hasColors ? rest : 0;
  for (std::size_t i = 0; i < normals; ++i) normals_.push_back(fits ? numbers[i].value : 0);
  if (colors > 0) colors_.add(vertex, numbers.subspan(normals, colors));
  for (std::size_t i = 0; i < texcoords; ++i)
    texcoords_.push_back(fits ? numbers[normals + colors + i].value : 0);
  if (!fits) ++misfits_;
  if (fits && !keyword_.hasColors && rest > 0) ++surplus_;
  // Two programs read the order of normals and colours differently; both interpretations are tried on every
  // vertex, and the one that fits all is taken.
  if (!keyword_.namesNormalsFirst || !fits) return;
  areGeomviews_ = areGeomviews_ && isUnit(numbers.first(3));
  areMeshLabs_ = areMeshLabs_ && colors == 4 && isUnit(numbers.subspan(4, 3)) &&
                 std::ranges::all_of(numbers.first(4), [](const OffNumber& n) { return isByte(n.value); });
}

/// What was taken for a normal and a color is a color and a normal.
void OffVertices::takeMeshLabOrder() {
  std::size_t at = 0;
  colors_.changeAll([&](std::span<double, 4> color) {
    const std::array<double, 3> first = {normals_[at], normals_[at + 1], normals_[at + 2]};
    for (std::size_t i = 0; i < 3; ++i) normals_[at + i] = color[i + 1];
    color[3] = color[0];
    std::ranges::copy(first, color.begin());
    at += 3;
  });
}

void OffVertices::finish(SurfaceMesh& mesh, bool isExact, bool withoutAlpha, Warnings& warnings) {
  if (keyword_.values() > 0 && misfits_ == vertices_) {
    if (vertices_ > 0)
      warnings.push_back({WarningCode::omitted,
                          "its vertices do not have the values that its keyword states; these are left out"});
    return;
  }
  if (keyword_.namesNormalsFirst && keyword_.hasColors && misfits_ == 0 && areMeshLabs_ && !areGeomviews_)
    takeMeshLabOrder();
  if (misfits_ > 0)
    warnings.push_back(
        {WarningCode::completed,
         fmt::format("{} not have the values that its keyword states; these are 0, and colours are white",
                     counted(misfits_, "vertex does", "vertices do"))});
  if (keyword_.hasNormals)
    mesh.vertexAttributes.push_back(
        attributeOfTextNumbers(std::string(kNormalName), AttributeMeaning::normal, 3, normals_));
  if (keyword_.hasColors) mesh.vertexAttributes.push_back(colors_.attribute(vertices_, isExact));
  if (keyword_.hasTexcoords)
    mesh.vertexAttributes.push_back(
        attributeOfTextNumbers(std::string(kTexcoordName), AttributeMeaning::textureCoords, 2, texcoords_));
  if (withoutAlpha && keyword_.hasColors) {
    Attribute& four = mesh.vertexAttributes[keyword_.hasNormals ? 1 : 0];
    if (four.components == 4) {
      Attribute three = emptyLike(four);
      three.components = 3;
      for (std::size_t i = 0; i < four.elementCount(); ++i)
        three.append(four.element(i).first(three.elementBytes()));
      four = std::move(three);
    }
  }
  if (surplus_ == 0) return;
  if (!unannounced_.isEmpty() && unannounced_.missing(vertices_) == 0) {
    mesh.vertexAttributes.push_back(unannounced_.attribute(vertices_, false));
    warnings.push_back({WarningCode::completed, "its vertices have colours that its keyword does not state"});
  } else {
    warnings.push_back(
        {WarningCode::omitted, fmt::format("{} values that its keyword does not state; these are left out",
                                           counted(surplus_, "vertex has", "vertices have"))});
  }
}

}  // namespace arete
