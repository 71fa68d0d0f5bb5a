// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where all faces use one set, that one is renamed. Else the coordinates become those of corners, and a wedge
// that faces of several sets share is split.
#include "io/formats/common/texture_set.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "surface/model/wedges.h"

namespace arete {
namespace {

constexpr std::uint32_t kNone = MeshAttributes::kNone;

std::string nameOf(std::uint32_t set) {
  return std::string(kTexcoordName) + (set == 0 ? "" : std::to_string(set));
}

Attribute* find(std::vector<Attribute>& attributes, const std::string& name) {
  const auto found = std::ranges::find_if(attributes, [&](const Attribute& a) {
    return a.name == name && a.meaning == AttributeMeaning::textureCoords;
  });
  return found == attributes.end() ? nullptr : &*found;
}

/// The set of a material; 0 where no picture of it says one.
std::uint32_t setOf(const Material& material) {
  for (const char* role : {"baseColor", "map_Kd"})
    for (const TextureUse& use : material.textures)
      if (use.role == role) return use.textureCoords;
  return material.textures.empty() ? 0 : material.textures.front().textureCoords;
}

bool hasSet(SurfaceMesh& mesh, std::uint32_t set) {
  return find(mesh.vertexAttributes, nameOf(set)) != nullptr ||
         find(mesh.wedgeAttributes, nameOf(set)) != nullptr;
}

/// Exchanges the names of the first set and of another one.
void exchange(SurfaceMesh& mesh, std::uint32_t set) {
  for (auto* const attributes : {&mesh.vertexAttributes, &mesh.wedgeAttributes})
    for (Attribute& attribute : *attributes) {
      if (attribute.meaning != AttributeMeaning::textureCoords) continue;
      if (attribute.name == kTexcoordName)
        attribute.name = nameOf(set);
      else if (attribute.name == nameOf(set))
        attribute.name = kTexcoordName;
    }
}

/// A number as a fraction, counted from the lower side of the picture.
std::vector<double> placeAt(const Attribute& attribute, std::uint32_t element) {
  std::vector<double> place = attribute.numbers(element);
  if (attribute.isNormalized && !isFloat(attribute.type)) {
    const int bits = static_cast<int>(8 * sizeOf(attribute.type));
    const bool isSigned = attribute.type == ScalarType::int8 || attribute.type == ScalarType::int16;
    const double largest = double((std::uint64_t{1} << (isSigned ? bits - 1 : bits)) - 1);
    for (double& number : place) number = std::max(number / largest, -1.0);
  }
  place.resize(2, 0);
  if (attribute.isFromTop) place[1] = 1 - place[1];
  return place;
}

/// Each face has the coordinates of its set, by wedges.
void mix(SurfaceMesh& mesh, const std::vector<std::uint32_t>& setOfFace) {
  moveToWedges(mesh);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  // wedge before, set
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t& wedge : mesh.wedges[t]) {
      const auto [at, isNew] =
          known.try_emplace({wedge, setOfFace[t]}, static_cast<std::uint32_t>(pairs.size()));
      if (isNew) pairs.emplace_back(wedge, setOfFace[t]);
      wedge = at->second;
    }
  bool areFloats = true;
  for (const Attribute& attribute : mesh.wedgeAttributes)
    areFloats = areFloats && (attribute.meaning != AttributeMeaning::textureCoords ||
                              attribute.type != ScalarType::float64);
  Attribute chosen{.name = std::string(kTexcoordName),
                   .meaning = AttributeMeaning::textureCoords,
                   .type = areFloats ? ScalarType::float32 : ScalarType::float64,
                   .components = 2};
  for (const auto& [wedge, set] : pairs) {
    const Attribute* const from = find(mesh.wedgeAttributes, nameOf(set));
    chosen.append(from ? placeAt(*from, wedge) : std::vector<double>(2, 0));
  }
  for (Attribute& attribute : mesh.wedgeAttributes) {
    Attribute to = emptyLike(attribute);
    for (const auto& [wedge, set] : pairs) to.append(attribute.element(wedge));
    attribute = std::move(to);
  }
  mesh.wedgeCount = static_cast<std::uint32_t>(pairs.size());
  if (Attribute* const first = find(mesh.wedgeAttributes, nameOf(0))) {
    std::uint32_t free = 1;
    while (find(mesh.wedgeAttributes, nameOf(free)) != nullptr) ++free;
    first->name = nameOf(free);
  }
  mesh.wedgeAttributes.push_back(std::move(chosen));
}

}  // namespace

std::optional<SurfaceMesh> withOneTextureSet(MeshRef source) {
  const MeshAttributes& attributes = source.attributes;
  std::vector<std::uint32_t> setOfMaterial;
  for (const Material& material : attributes.materials) setOfMaterial.push_back(setOf(material));
  if (attributes.materialOf.empty() || std::ranges::all_of(setOfMaterial, [](auto set) { return set == 0; }))
    return std::nullopt;
  SurfaceMesh mesh;
  mesh.shape() = source.shape;
  static_cast<MeshAttributes&>(mesh) = attributes;
  for (std::uint32_t& set : setOfMaterial)
    if (!hasSet(mesh, set)) set = 0;
  std::vector<std::uint32_t> setOfFace;
  for (const std::uint32_t material : attributes.materialOf)
    setOfFace.push_back(material == kNone ? kNone : setOfMaterial[material]);
  // A face without a material has no picture: it has what most others have, the first of them.
  std::uint32_t common = 0;
  bool areSeveral = false, isAny = false;
  for (const std::uint32_t set : setOfFace) {
    if (set == kNone) continue;
    areSeveral = areSeveral || (isAny && set != common);
    if (!isAny) common = set;
    isAny = true;
  }
  if (!areSeveral && common == 0) return std::nullopt;
  if (areSeveral) {
    for (std::uint32_t& set : setOfFace)
      if (set == kNone) set = 0;
    mix(mesh, setOfFace);
  } else {
    exchange(mesh, common);
  }
  for (std::size_t m = 0; m < mesh.materials.size(); ++m)
    for (TextureUse& use : mesh.materials[m].textures)
      if (use.textureCoords == setOfMaterial[m]) use.textureCoords = 0;
  return mesh;
}

}  // namespace arete
