// SPDX-License-Identifier: GPL-3.0-or-later
//
// First the attributes whose properties have names that every program knows, then the rest, so that no other
// attribute takes such a name.
#include "io/formats/ply/columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <set>
#include <utility>

#include "io/formats/common/colors.h"
#include "io/formats/common/text_numbers.h"

namespace arete {

namespace {

using Names = std::set<std::string, std::less<>>;

/// A PLY word of a name, which blanks and control characters would end.
std::string wordOf(std::string_view name) {
  std::string word(name);
  for (char& c : word)
    if (static_cast<unsigned char>(c) <= ' ' || c == 127) c = '_';
  return word.empty() ? "attribute" : word;
}

class ColumnMaker {
 public:
  ColumnMaker(const MeshAttributes& mesh, const MeshWriteOptions& options, bool withTextures) : mesh_(mesh) {
    vertexNames_ = {"x", "y", "z"};
    if (!options.vertexQualities.empty()) vertexNames_.insert("quality");
    if (!options.vertexColors.empty()) vertexNames_.insert({"red", "green", "blue"});
    faceNames_ = {"vertex_indices", "vertex_index", "texcoord"};
    if (withTextures) faceNames_.insert("texnumber");
    if (!options.triangleErrors.empty()) faceNames_.insert("error");
  }

  PlyColumns make() {
    for (const bool isKnown : {true, false}) {
      for (const Attribute& attribute : mesh_.vertexAttributes) addVector(attribute, false, isKnown);
      for (const Attribute& attribute : mesh_.triangleAttributes) addVector(attribute, true, isKnown);
      for (const Attribute& attribute : mesh_.wedgeAttributes) addCorners(attribute, isKnown);
    }
    if (isColorRounded_) columns_.lost.push_back("colours finer than 8 bits");
    if (isTexcoordRounded_) columns_.lost.push_back("texture coordinates finer than 32-bit floats");
    return std::move(columns_);
  }

 private:
  /// The names that every program knows for the components; empty: there are none.
  static std::vector<std::string> knownNames(const Attribute& attribute, bool isFace) {
    const auto is = [&](std::string_view name, AttributeMeaning meaning) {
      return attribute.name == name && attribute.meaning == meaning;
    };
    const bool isFraction = isFloat(attribute.type) || attribute.isNormalized;
    if (is(kNormalName, AttributeMeaning::normal) && attribute.components == 3 && isFraction)
      return {"nx", "ny", "nz"};
    if (is(kColorName, AttributeMeaning::color) && isColor(attribute)) {
      std::vector<std::string> names = {"red", "green", "blue", "alpha"};
      names.resize(attribute.components);
      return names;
    }
    if (is(kTexcoordName, AttributeMeaning::textureCoords) && isFraction && !isFace) {
      if (attribute.components == 2) return {"s", "t"};
      if (attribute.components == 3) return {"texture_u", "texture_v", "texture_w"};
    }
    return {};
  }

  static bool isColor(const Attribute& attribute) {
    return attribute.meaning == AttributeMeaning::color &&
           (attribute.components == 3 || attribute.components == 4) &&
           (isFloat(attribute.type) || attribute.type == ScalarType::uint8 ||
            attribute.type == ScalarType::uint16);
  }

  void addVector(const Attribute& attribute, bool isFace, bool isKnown) {
    Names& taken = isFace ? faceNames_ : vertexNames_;
    std::vector<std::string> names = knownNames(attribute, isFace);
    const bool hasKnownNames =
        !names.empty() && std::ranges::none_of(names, [&](const auto& name) { return taken.contains(name); });
    // A name that is free now is taken in the second round.
    if (isKnown != (hasKnownNames || done_.contains(&attribute))) return;
    if (!done_.insert(&attribute).second) return;
    const Attribute* const values = converted(attribute, false);
    const bool isList = !hasKnownNames && isFace && attribute.components > 1;
    if (!hasKnownNames) names = freeNames(*values, isFace, taken);
    for (const std::string& name : names) taken.insert(name);
    (isFace ? columns_.faces : columns_.vertices).push_back({values, std::move(names), isList});
  }

  /// Names for an attribute that no program knows, and a note where they do not say it all.
  std::vector<std::string> freeNames(const Attribute& attribute, bool isFace, const Names& taken) {
    const std::size_t scalars = isFace ? 1 : attribute.components;
    std::string word = wordOf(attribute.name);
    // The reader would take it for a list of corners, a color of corners or an error.
    if (isFace && (word.starts_with("corner_") || word == "color" ||
                   (word == "error" && attribute.type != ScalarType::float32)))
      word = "face_" + word;
    std::vector<std::string> names;
    for (;; word += '_') {
      names.clear();
      for (std::size_t i = 0; i < scalars; ++i)
        names.push_back(scalars == 1 ? word : fmt::format("{}_{}", word, i));
      if (std::ranges::none_of(names, [&](const auto& name) { return taken.contains(name); })) break;
    }
    if (scalars > 1 || word != attribute.name || attribute.isNormalized)
      columns_.notes.push_back(
          {isFace ? "face" : "vertex", word, attribute.components, attribute.isNormalized, attribute.name});
    return names;
  }

  void addCorners(const Attribute& attribute, bool isKnown) {
    const bool isTexcoord = attribute.name == kTexcoordName && attribute.components == 2 &&
                            attribute.meaning == AttributeMeaning::textureCoords;
    const bool isFloatColor = attribute.name == kColorName && isColor(attribute) &&
                              attribute.type == ScalarType::float32 &&
                              attribute.colorSpace != ColorSpace::linear && attribute.components == 3;
    if ((isTexcoord || isFloatColor) != isKnown) return;
    std::string name = isTexcoord ? "texcoord" : isFloatColor ? "color" : "corner_" + wordOf(attribute.name);
    while (cornerNames_.contains(name)) name += '_';
    cornerNames_.insert(name);
    const Attribute* const values = converted(attribute, isTexcoord);
    if (!isKnown && (name != "corner_" + attribute.name || values->isNormalized))
      columns_.notes.push_back({"corner", name, values->components, values->isNormalized, attribute.name});
    columns_.corners.push_back({values, {std::move(name)}, true});
  }

  /// The attribute with the numbers that a PLY has for it.
  const Attribute* converted(const Attribute& attribute, bool mustBeFloat) {
    switch (attribute.meaning) {
      case AttributeMeaning::color:
        if (attribute.colorSpace != ColorSpace::linear || !isColor(attribute)) return &attribute;
        return &columns_.converted.emplace_back(toSrgb8(attribute, isColorRounded_));
      case AttributeMeaning::textureCoords:
        return withFloats(attribute, mustBeFloat, attribute.isFromTop);
      case AttributeMeaning::normal:
      case AttributeMeaning::tangent:
        return withFloats(attribute, false, false);
      default:
        return &attribute;
    }
  }

  /// Fractions of integers become floats, which are fine enough to tell all of them.
  const Attribute* withFloats(const Attribute& attribute, bool mustBeFloat, bool isTurned) {
    const bool isFraction = attribute.isNormalized && !isFloat(attribute.type);
    if (!isFraction && !isTurned && (!mustBeFloat || attribute.type == ScalarType::float32))
      return &attribute;
    Attribute& result = columns_.converted.emplace_back(emptyLike(attribute));
    result.isFromTop = false;
    if (isFraction || mustBeFloat) result.type = ScalarType::float32;
    if (isFraction) result.isNormalized = false;
    result.values.reserve(attribute.elementCount() * result.elementBytes());
    for (std::size_t i = 0; i < attribute.elementCount(); ++i) {
      std::vector<double> numbers = attribute.numbers(i);
      for (double& number : numbers) number = fractionOf(attribute, number);
      if (isTurned && numbers.size() > 1) numbers[1] = 1 - numbers[1];
      if (!isFraction && result.type == ScalarType::float32)
        for (const double number : numbers)
          if (double(float(number)) != number && !std::isnan(number)) isTexcoordRounded_ = true;
      result.append(numbers);
    }
    return &result;
  }

  const MeshAttributes& mesh_;
  PlyColumns columns_;
  Names vertexNames_, faceNames_, cornerNames_;
  std::set<const Attribute*> done_;
  bool isColorRounded_ = false, isTexcoordRounded_ = false;
};

}  // namespace

PlyColumns plyColumns(const MeshAttributes& mesh, const MeshWriteOptions& options, bool withTextures) {
  return ColumnMaker(mesh, options, withTextures).make();
}

std::string_view plyTypeName(PlyType type) {
  constexpr std::array<std::string_view, 8> kNames = {"char", "uchar", "short", "ushort",
                                                      "int",  "uint",  "float", "double"};
  return kNames[static_cast<std::size_t>(type)];
}

}  // namespace arete
