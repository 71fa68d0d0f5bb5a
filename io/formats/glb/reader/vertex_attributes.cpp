// SPDX-License-Identifier: GPL-3.0-or-later
//
// The elements of an attribute are copied where nothing changes them: no morph target, and for a direction no
// node that turns it. Else they are computed in doubles and rounded to 32-bit floats.
//
// One type holds two others: 16 bits hold fractions of 255 exactly, since 65535 is 257 times 255; of whole
// numbers, the shortest that has both ranges; else floats, of 64 bits where there are whole numbers of 32.
#include "io/formats/glb/reader/vertex_attributes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "engine/base/counted.h"
#include "io/files/text_scan.h"

namespace arete {

namespace {

constexpr std::size_t kMostColumns = 256;
constexpr const char *kNormal = "NORMAL", *kTangent = "TANGENT", *kPosition = "POSITION", *kErrors = "_ERROR";

/// "texcoord" and "1" of "TEXCOORD_1"; nothing if the name is of another kind.
std::optional<std::string> setName(const std::string& fileName, std::string_view kind,
                                   std::string_view name) {
  if (!fileName.starts_with(kind)) return std::nullopt;
  const std::string_view set = std::string_view(fileName).substr(kind.size());
  if (set.empty() || set.size() > 9 || set.find_first_not_of("0123456789") != std::string_view::npos)
    return std::nullopt;
  if (set.size() > 1 && set[0] == '0') return std::nullopt;
  return std::string(name) + (set == "0" ? std::string() : std::string(set));
}

bool isSigned(ScalarType type) {
  return type == ScalarType::int8 || type == ScalarType::int16 || type == ScalarType::int32;
}

/// A type that holds the numbers of both.
std::pair<ScalarType, bool> commonType(const Attribute& a, const Attribute& b) {
  if (a.type == b.type && a.isNormalized == b.isNormalized) return {a.type, a.isNormalized};
  const std::size_t longest = std::max(sizeOf(a.type), sizeOf(b.type));
  const bool areWhole = !isFloat(a.type) && !isFloat(b.type);
  if (areWhole && a.isNormalized && b.isNormalized && !isSigned(a.type) && !isSigned(b.type) && longest <= 2)
    return {ScalarType::uint16, true};
  if (areWhole && !a.isNormalized && !b.isNormalized) {
    const bool hasSign = isSigned(a.type) || isSigned(b.type);
    if (!hasSign) return {longest == 2 ? ScalarType::uint16 : ScalarType::uint32, false};
    std::size_t bits = 0;  // of a signed type
    for (const ScalarType type : {a.type, b.type})
      bits = std::max(bits, 8 * sizeOf(type) + (isSigned(type) ? 0 : 1));
    if (bits <= 16) return {ScalarType::int16, false};
    if (bits <= 32) return {ScalarType::int32, false};
    return {ScalarType::float64, false};
  }
  const auto needsDouble = [](const Attribute& x) {
    return x.type == ScalarType::float64 || (!isFloat(x.type) && sizeOf(x.type) == 4);
  };
  return {needsDouble(a) || needsDouble(b) ? ScalarType::float64 : ScalarType::float32, false};
}

/// Appends a number, with the fraction taken, in the type of an attribute.
void appendValue(Attribute& to, std::vector<double>& element) {
  if (to.isNormalized)
    for (double& value : element) value *= GltfElements::largestOf(to.type);
  to.append(element);
}

/// The element of a vertex that does not have the attribute.
std::vector<double> missingElement(const Attribute& attribute) {
  return std::vector<double>(attribute.components, attribute.meaning == AttributeMeaning::color ? 1 : 0);
}

void fillTo(Attribute& attribute, std::uint64_t elements) {
  const std::size_t size = attribute.elementBytes(), before = attribute.values.size() / size;
  if (elements <= before) return;
  std::vector<double> missing = missingElement(attribute);
  Attribute one = emptyLike(attribute);
  appendValue(one, missing);
  attribute.values.resize(elements * size);
  if (attribute.meaning != AttributeMeaning::color) return;
  for (std::uint64_t i = before; i < elements; ++i)
    std::memcpy(attribute.values.data() + i * size, one.values.data(), size);
}

/// Changes an attribute to another type with more components or as many; those that are new are as missing.
void convert(Attribute& attribute, ScalarType type, bool isNormalized, std::uint8_t components) {
  Attribute to = emptyLike(attribute);
  to.type = type;
  to.isNormalized = isNormalized;
  to.components = components;
  const std::size_t count = attribute.values.size() / attribute.elementBytes();
  to.values.reserve(count * to.elementBytes());
  const double largest = attribute.isNormalized ? GltfElements::largestOf(attribute.type) : 1;
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<double> element = attribute.numbers(i);
    for (double& value : element)
      value = std::max(value / largest, attribute.isNormalized ? -1.0 : value / largest);
    element.resize(components, attribute.meaning == AttributeMeaning::color ? 1 : 0);
    appendValue(to, element);
  }
  attribute = std::move(to);
}

bool isMoved(const VertexGroup& group, const GltfAttribute& attribute) {
  return std::ranges::any_of(group.primitive.morphs,
                             [&](const GltfMorph& morph) { return morph.name == attribute.name; });
}

/// Whether the elements are those of the file.
bool isCopied(const VertexGroup& group, const GltfAttribute& attribute) {
  if (isMoved(group, attribute)) return false;
  if (attribute.name == kNormal) return group.placed.keepsDirections();
  if (attribute.name == kTangent) return group.placed.keepsDirections();
  return true;
}

/// An element with the fraction taken, moved and turned.
void computeElement(const VertexGroup& group, const GltfAttribute& attribute, std::uint32_t vertex,
                    std::vector<double>& element) {
  element.clear();
  for (std::size_t c = 0; c < attribute.elements.components; ++c)
    element.push_back(group.valueOf(attribute, vertex, c));
  const bool isNormal = attribute.name == kNormal, isTangent = attribute.name == kTangent;
  if (isNormal || isTangent) {
    Vec3 v{element[0], element[1], element[2]};
    if (const double length = std::hypot(v.x, v.y, v.z); isMoved(group, attribute) && length > 0)
      v = {v.x / length, v.y / length, v.z / length};
    const Vec3 turned = isNormal ? group.placed.normalOf(v) : group.placed.directionOf(v);
    element[0] = turned.x;
    element[1] = turned.y;
    element[2] = turned.z;
    if (isTangent && group.placed.mirrors()) element[3] = -element[3];
  } else if (attribute.name.starts_with("COLOR_") && isMoved(group, attribute)) {
    for (double& value : element) value = std::clamp(value, 0.0, 1.0);
  }
}

}  // namespace

bool GltfVertexAttributes::isLeftOut(const GltfAttribute& attribute) const {
  return attribute.name == kPosition ||
         (isOfFrame_ && (attribute.name == kNormal || attribute.name == kErrors));
}

GltfVertexAttributes::Column* GltfVertexAttributes::find(const std::string& fileName) {
  const auto found = std::ranges::find(columns_, fileName, &Column::fileName);
  return found == columns_.end() ? nullptr : &*found;
}

GltfVertexAttributes::Column GltfVertexAttributes::columnOf(const VertexGroup& group,
                                                            const GltfAttribute& attribute) const {
  const GltfElements& elements = attribute.elements;
  Column column{.fileName = attribute.name,
                .attribute = {.name = attribute.name,
                              .type = elements.type,
                              .components = elements.components,
                              .isNormalized = elements.isNormalized}};
  Attribute& to = column.attribute;
  const auto texcoord = setName(attribute.name, "TEXCOORD_", kTexcoordName),
             color = setName(attribute.name, "COLOR_", kColorName);
  if (attribute.name == kNormal) {
    to.name = kNormalName;
    to.meaning = AttributeMeaning::normal;
  } else if (attribute.name == kTangent) {
    to.name = kTangentName;
    to.meaning = AttributeMeaning::tangent;
  } else if (texcoord) {
    to.name = *texcoord;
    to.meaning = AttributeMeaning::textureCoords;
    to.isFromTop = true;
  } else if (color) {
    to.name = *color;
    to.meaning = AttributeMeaning::color;
    to.colorSpace = ColorSpace::linear;
    // The standard has no other colors in whole numbers; exporters forget to say it.
    column.isGuessed = !isFloat(to.type) && !to.isNormalized;
    if (column.isGuessed) to.isNormalized = true;
  } else if (to.name.starts_with(kNormalName) || to.name.starts_with(kTangentName) ||
             to.name.starts_with(kTexcoordName) || to.name.starts_with(kColorName)) {
    to.name = "_" + to.name;  // not to be taken for one of ours
  }
  if (!isCopied(group, attribute)) {
    to.type = ScalarType::float32;
    to.isNormalized = false;
  }
  return column;
}

// This estimates the memory before anything is stored, so that a small file cannot make the reader take much.
std::uint64_t GltfVertexAttributes::bytesAfter(const VertexGroup& group, std::uint64_t first,
                                               std::uint64_t count) const {
  std::uint64_t perVertex = 0;
  for (const Column& column : columns_) perVertex += column.attribute.elementBytes();
  for (const GltfAttribute& attribute : group.primitive.attributes)
    perVertex += std::uint64_t{attribute.elements.components} * sizeof(float);
  return perVertex * (first + count);
}

// The attributes of a group are added to columns that grow with the groups. Vertices of earlier groups that
// lack the attribute are filled in first.
void GltfVertexAttributes::add(const VertexGroup& group, std::uint64_t first, std::uint64_t count) {
  for (const GltfAttribute& attribute : group.primitive.attributes) {
    if (isLeftOut(attribute)) continue;
    Column wanted = columnOf(group, attribute);
    Column* column = find(attribute.name);
    if (column == nullptr && columns_.size() == kMostColumns) {
      hasTooMany_ = true;
      continue;
    }
    if (column == nullptr) {
      const auto isTaken = [&](const Column& other) { return other.attribute.name == wanted.attribute.name; };
      while (std::ranges::any_of(columns_, isTaken)) wanted.attribute.name += "_";
      columns_.push_back(wanted);
      column = &columns_.back();
    }
    Attribute& to = column->attribute;
    column->isGuessed |= wanted.isGuessed;
    fillTo(to, first);
    // A column takes the type that holds both the old and the new elements; the old ones are converted at
    // most when that type changes.
    const auto [type, isNormalized] = commonType(to, wanted.attribute);
    const std::uint8_t components = std::max(to.components, wanted.attribute.components);
    if (type != to.type || isNormalized != to.isNormalized || components != to.components) {
      column->hasSeveralTypes |= type != to.type || isNormalized != to.isNormalized;
      convert(to, type, isNormalized, components);
    } else if (type != wanted.attribute.type || isNormalized != wanted.attribute.isNormalized) {
      column->hasSeveralTypes = true;
    }
    column->filled += count;
    // Equal types are copied byte by byte, so that the numbers of the file survive to the bit.
    const GltfElements& from = attribute.elements;
    if (isCopied(group, attribute) && from.type == to.type && from.components == to.components &&
        from.isPacked() && (from.isNormalized || column->isGuessed) == to.isNormalized) {
      for (std::uint64_t i = 0; i < count; ++i) {
        const auto* const bytes = reinterpret_cast<const std::byte*>(from.at(group.vertex(i), 0));
        to.values.insert(to.values.end(), bytes, bytes + to.elementBytes());
      }
      continue;
    }
    // Whole numbers that are guessed to be fractions have no fraction taken yet, which the division makes up
    // for.
    std::vector<double> element;
    const double guessed = wanted.isGuessed ? GltfElements::largestOf(from.type) : 1;
    for (std::uint64_t i = 0; i < count; ++i) {
      computeElement(group, attribute, group.vertex(i), element);
      for (double& value : element) value /= guessed;
      element.resize(to.components, to.meaning == AttributeMeaning::color ? 1 : 0);
      appendValue(to, element);
    }
  }
}

// What the reader changed or filled in is said once for each attribute, and vertices behind the last group
// with it are filled.
std::vector<Attribute> GltfVertexAttributes::finish(std::uint64_t vertices, Warnings& warnings) {
  std::vector<Attribute> attributes;
  if (hasTooMany_)
    warnings.push_back(
        {WarningCode::omitted, fmt::format("attributes beyond the first {} are left out", kMostColumns)});
  for (Column& column : columns_) {
    const std::string name = text::quotedToken(column.fileName);
    if (column.filled < vertices)
      warnings.push_back(
          {WarningCode::completed,
           fmt::format("{} of {} {} not have the attribute {}, which is {} there", vertices - column.filled,
                       vertices, agreeing(vertices, "vertex does", "vertices do"), name,
                       column.attribute.meaning == AttributeMeaning::color ? 1 : 0)});
    if (column.hasSeveralTypes)
      warnings.push_back(
          {WarningCode::completed,
           fmt::format("the attribute {} has several types of numbers, which become one", name)});
    if (column.isGuessed)
      warnings.push_back(
          {WarningCode::completed,
           fmt::format(
               "the attribute {} is of whole numbers that are not marked as fractions, and taken for them",
               name)});
    fillTo(column.attribute, vertices);
    attributes.push_back(std::move(column.attribute));
  }
  return attributes;
}

}  // namespace arete
