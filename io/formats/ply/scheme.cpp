// SPDX-License-Identifier: GPL-3.0-or-later
//
// First the properties that have a place of their own, then the groups that make up a vector, last the rest,
// each an attribute of its own.
#include "io/formats/ply/scheme.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "io/files/text_scan.h"

namespace arete {

namespace {

using Kind = PlyRole::Kind;

/// Comparing the names of attributes in pairs, as checks of a mesh do, must not take long.
constexpr std::size_t kMostAttributes = 1000;
constexpr std::string_view kCorner = "corner_";

struct Group {
  std::string_view name;
  AttributeMeaning meaning;
  std::vector<std::string_view> parts;
  std::size_t least;
  /// A property that says that the others mean something else: u v w are a velocity.
  std::string_view except = {};
};

const std::vector<Group>& groups() {
  static const std::vector<Group> kGroups = {
      {kNormalName, AttributeMeaning::normal, {"nx", "ny", "nz"}, 3},
      {kColorName, AttributeMeaning::color, {"red", "green", "blue", "alpha"}, 3},
      {kColorName,
       AttributeMeaning::color,
       {"diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"},
       3},
      {kColorName, AttributeMeaning::color, {"r", "g", "b", "a"}, 3},
      {kTexcoordName, AttributeMeaning::textureCoords, {"s", "t"}, 2},
      {kTexcoordName, AttributeMeaning::textureCoords, {"u", "v"}, 2, "w"},
      {kTexcoordName, AttributeMeaning::textureCoords, {"texture_u", "texture_v", "texture_w"}, 2}};
  return kGroups;
}

/// Colours are fractions, and integers of 32 bits are hardly meant as fractions of four billion.
bool canMean(AttributeMeaning meaning, PlyType type) {
  if (meaning == AttributeMeaning::other) return true;
  if (meaning == AttributeMeaning::color)
    return isFloat(type) || type == PlyType::uint8 || type == PlyType::uint16;
  return isFloat(type);
}

/// "color", "color1", ...: the meaning that the name of an attribute has.
AttributeMeaning meaningOf(std::string_view name, std::uint8_t components) {
  while (!name.empty() && name.back() >= '0' && name.back() <= '9') name.remove_suffix(1);
  if (name == kNormalName && components == 3) return AttributeMeaning::normal;
  if (name == kTangentName && components == 4) return AttributeMeaning::tangent;
  if (name == kTexcoordName && components >= 2) return AttributeMeaning::textureCoords;
  if (name == kColorName && (components == 3 || components == 4)) return AttributeMeaning::color;
  return AttributeMeaning::other;
}

class SchemeMaker {
 public:
  SchemeMaker(const PlyElement& element, const std::vector<PlyNote>& notes)
      : element_(element), notes_(notes), isTaken_(element.properties.size(), false) {
    scheme.roles.resize(element.properties.size());
    for (std::size_t p = 0; p < element.properties.size(); ++p)
      if (!element.properties[p].isList) scalars_[element.properties[p].name].push_back(p);
  }

  void take(std::size_t property, Kind kind) {
    isTaken_[property] = true;
    scheme.roles[property].kind = kind;
  }

  /// Scalars that `notes` say are one vector, and those that the names say are.
  void takeGroups(bool withTexcoords) {
    for (const PlyNote& note : notes_) {
      if (note.element != element_.name || note.components < 2) continue;
      std::vector<std::string> parts;
      for (unsigned i = 0; i < note.components; ++i) parts.push_back(fmt::format("{}_{}", note.property, i));
      takeGroup(
          {note.name, meaningOf(note.name, note.components), {parts.begin(), parts.end()}, parts.size()},
          note.isNormalized);
    }
    for (const Group& group : groups())
      if ((withTexcoords || group.meaning != AttributeMeaning::textureCoords) &&
          (group.except.empty() || !find(group.except)))
        takeGroup(group, false);
  }

  void takeCornerLists() {
    for (std::size_t p = 0; p < scheme.roles.size(); ++p) {
      const PlyProperty& property = element_.properties[p];
      if (isTaken_[p] || !property.isList) continue;
      const std::string lower = text::lowered(property.name);
      if (lower == kTexcoordName) {
        addCornerList(p, std::string(kTexcoordName), 0, false);
      } else if (lower == kColorName && isFloat(property.type)) {
        addCornerList(p, std::string(kColorName), 0, false);
      } else if (property.name.starts_with(kCorner)) {
        const PlyNote* note = noteFor("corner", property.name);
        addCornerList(p, note ? note->name : property.name.substr(kCorner.size()),
                      note ? note->components : std::uint8_t{0}, note && note->isNormalized);
      }
    }
  }

  void takeRest() {
    for (std::size_t p = 0; p < scheme.roles.size(); ++p) {
      const PlyProperty& property = element_.properties[p];
      if (isTaken_[p]) continue;
      if (scheme.attributes.size() >= kMostAttributes) {
        ++scheme.leftOut;
        continue;
      }
      const PlyNote* note = noteFor(element_.name, property.name);
      scheme.roles[p] = {property.isList ? Kind::list : Kind::number,
                         static_cast<std::uint32_t>(scheme.attributes.size()), 0};
      scheme.attributes.push_back({.name = names_.unique(note ? note->name : property.name),
                                   .type = property.type,
                                   .components = property.isList ? std::uint8_t{0} : std::uint8_t{1},
                                   .isNormalized = note && note->isNormalized});
    }
  }

  /// Puts the attributes into the order of their first properties.
  void sort() {
    std::vector<std::uint32_t> place(scheme.attributes.size(), static_cast<std::uint32_t>(-1));
    std::vector<Attribute> sorted;
    for (PlyRole& role : scheme.roles) {
      if (role.kind != Kind::number && role.kind != Kind::list) continue;
      std::uint32_t& at = place[role.attribute];
      if (at > sorted.size()) {
        at = static_cast<std::uint32_t>(sorted.size());
        sorted.push_back(std::move(scheme.attributes[role.attribute]));
      }
      role.attribute = at;
    }
    scheme.attributes = std::move(sorted);
  }

  PlyScheme scheme;

 private:
  /// Tells names of attributes apart.
  struct Names {
    std::set<std::string, std::less<>> used;
    std::string unique(std::string name) {
      const bool isSet = meaningOf(name, 3) != AttributeMeaning::other || name == kTangentName;
      for (int i = isSet ? 1 : 2; used.contains(name); ++i) {
        std::string other = fmt::format("{}{}{}", name, isSet ? "" : "_", i);
        if (!used.contains(other)) name = std::move(other);
      }
      used.insert(name);
      return name;
    }
  };

  /// The scalar of a name: the only one of that spelling, or of any.
  std::optional<std::size_t> find(std::string_view name) const {
    const auto exact = scalars_.find(name);
    if (exact != scalars_.end())
      return exact->second.size() == 1 ? std::optional(exact->second.front()) : std::nullopt;
    std::optional<std::size_t> found;
    if (name.size() > 1)
      for (const auto& [other, properties] : scalars_) {
        if (other.size() != name.size() || text::lowered(other) != name) continue;
        if (found || properties.size() != 1) return std::nullopt;
        found = properties.front();
      }
    return found;
  }

  void takeGroup(const Group& group, bool isNormalized) {
    std::vector<std::size_t> properties;
    for (const std::string_view part : group.parts) {
      const std::optional<std::size_t> p = find(part);
      const bool fits =
          p && !isTaken_[*p] && canMean(group.meaning, element_.properties[*p].type) &&
          (properties.empty() || element_.properties[*p].type == element_.properties[properties[0]].type);
      if (!fits) break;
      properties.push_back(*p);
    }
    if (properties.size() < group.least || scheme.attributes.size() >= kMostAttributes) return;
    const PlyType type = element_.properties[properties[0]].type;
    const bool isColor = group.meaning == AttributeMeaning::color;
    for (std::size_t i = 0; i < properties.size(); ++i) {
      take(properties[i], Kind::number);
      scheme.roles[properties[i]].attribute = static_cast<std::uint32_t>(scheme.attributes.size());
      scheme.roles[properties[i]].offset = static_cast<std::uint32_t>(i * sizeOf(type));
    }
    scheme.attributes.push_back({.name = names_.unique(std::string(group.name)),
                                 .meaning = group.meaning,
                                 .type = type,
                                 .components = static_cast<std::uint8_t>(properties.size()),
                                 .isNormalized = isNormalized || (isColor && !isFloat(type)),
                                 .colorSpace = isColor ? ColorSpace::srgb : ColorSpace::none});
  }

  void addCornerList(std::size_t p, std::string name, std::uint8_t components, bool isNormalized) {
    if (scheme.corners.size() >= kMostAttributes) return;
    take(p, Kind::cornerList);
    scheme.roles[p].attribute = static_cast<std::uint32_t>(scheme.corners.size());
    scheme.corners.push_back({.name = cornerNames_.unique(std::move(name)),
                              .type = element_.properties[p].type,
                              .components = components,
                              .isNormalized = isNormalized});
  }

  const PlyNote* noteFor(std::string_view element, std::string_view property) const {
    for (const PlyNote& note : notes_)
      if (note.element == element && note.property == property) return &note;
    return nullptr;
  }

  const PlyElement& element_;
  const std::vector<PlyNote>& notes_;
  std::vector<bool> isTaken_;
  std::map<std::string, std::vector<std::size_t>, std::less<>> scalars_;  // properties by name
  Names names_, cornerNames_;
};

}  // namespace

std::size_t PlyScheme::count(PlyRole::Kind kind) const {
  return static_cast<std::size_t>(std::ranges::count(roles, kind, &PlyRole::kind));
}

void giveMeaning(Attribute& attribute) {
  attribute.meaning = meaningOf(attribute.name, attribute.components);
  // A type that cannot have the meaning leaves plain numbers.
  if (!canMean(attribute.meaning, attribute.type) && !attribute.isNormalized)
    attribute.meaning = AttributeMeaning::other;
  if (attribute.meaning != AttributeMeaning::color) return;
  attribute.colorSpace = ColorSpace::srgb;
  attribute.isNormalized = !isFloat(attribute.type);
}

PlyScheme vertexScheme(const PlyElement& element, const std::vector<PlyNote>& notes) {
  SchemeMaker maker(element, notes);
  for (std::size_t p = 0; p < element.properties.size(); ++p) {
    const PlyProperty& property = element.properties[p];
    // Coordinates are single numbers with names of one letter.
    if (property.isList || property.name.size() != 1) continue;
    if (property.name == "x") maker.take(p, Kind::x);
    if (property.name == "y") maker.take(p, Kind::y);
    if (property.name == "z") maker.take(p, Kind::z);
  }
  maker.takeGroups(true);
  maker.takeRest();
  maker.sort();
  return std::move(maker.scheme);
}

PlyScheme faceScheme(const PlyElement& element, const std::vector<PlyNote>& notes, bool withTextures,
                     bool withAttributes) {
  SchemeMaker maker(element, notes);
  bool hasNumber = false, hasError = false;
  // A second error or texture number stays an attribute like any other.
  for (std::size_t p = 0; p < element.properties.size(); ++p) {
    const PlyProperty& property = element.properties[p];
    if (property.isList && (property.name == "vertex_indices" || property.name == "vertex_index"))
      maker.take(p, Kind::indices);
    else if (!property.isList && property.name == "error" && withAttributes && !hasError)
      maker.take(p, Kind::error), hasError = true;
    else if (!property.isList && withTextures && !hasNumber && text::lowered(property.name) == "texnumber")
      maker.take(p, Kind::textureNumber), hasNumber = true;
  }
  if (!withAttributes) return std::move(maker.scheme);
  maker.takeCornerLists();
  maker.takeGroups(false);
  maker.takeRest();
  maker.sort();
  return std::move(maker.scheme);
}

PlyScheme stripScheme(const PlyElement& element) {
  static const std::vector<PlyNote> kNone;
  SchemeMaker maker(element, kNone);
  for (std::size_t p = 0; p < element.properties.size(); ++p)
    if (element.properties[p].isList &&
        (element.properties[p].name == "vertex_indices" || element.properties[p].name == "vertex_index"))
      maker.take(p, Kind::indices);
  return std::move(maker.scheme);
}

}  // namespace arete
