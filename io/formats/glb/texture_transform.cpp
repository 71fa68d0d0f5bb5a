// SPDX-License-Identifier: GPL-3.0-or-later
//
// A transform scales, turns and moves, in this order. The sense of the turn is that of the programs and of
// the sample model, u' = u cos + v sin, v' = v cos - u sin; the code in the text of the extension has the
// other one, which contradicts its own words (github.com/KhronosGroup/glTF/issues/1563).
//
// Materials of equal transforms form a class. If all triangles around each vertex are of one class, the
// coordinates of vertices are changed; else those of wedges, and a wedge of several classes is split.
#include "io/formats/glb/texture_transform.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "io/files/text_scan.h"
#include "io/formats/glb/texture_options.h"
#include "surface/model/wedges.h"

namespace arete {

namespace {

using Json = nlohmann::json;

constexpr const char* kExtension = "KHR_texture_transform";

struct UvTransform {
  std::array<double, 2> offset{0, 0}, scale{1, 1};
  double rotation = 0;
  auto operator<=>(const UvTransform&) const = default;

  std::array<double, 2> operator()(double u, double v) const {
    const double c = std::cos(rotation), s = std::sin(rotation);
    const double x = u * scale[0], y = v * scale[1];
    return {x * c + y * s + offset[0], y * c - x * s + offset[1]};
  }
};

/// By set of texture coordinates.
using Transforms = std::map<std::uint32_t, UvTransform>;

void readPair(const Json& object, const char* key, std::array<double, 2>& to) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array() || found->size() != 2) return;
  if ((*found)[0].is_number() && (*found)[1].is_number()) to = {(*found)[0], (*found)[1]};
}

/// Takes the transform of a texture out of the material; nothing if it has none. Sets the set it is for.
std::optional<UvTransform> take(Material& material, TextureUse& use) {
  const auto kept = material.verbatim.find("gltf:" + use.role);
  if (kept == material.verbatim.end()) return std::nullopt;
  Json json = Json::parse(kept->second, nullptr, false);
  const Json::json_pointer place(std::string("/extensions/") + kExtension);
  if (!json.is_object() || !json.contains(place) || !json[place].is_object()) return std::nullopt;
  const Json stated = json[place];
  UvTransform transform;
  readPair(stated, "offset", transform.offset);
  readPair(stated, "scale", transform.scale);
  if (const auto turn = stated.find("rotation"); turn != stated.end() && turn->is_number())
    transform.rotation = *turn;
  if (const auto set = stated.find("texCoord");
      set != stated.end() && set->is_number_unsigned() && set->get<std::uint64_t>() < MeshAttributes::kNone)
    use.textureCoords = *set;
  json["extensions"].erase(kExtension);
  if (json["extensions"].empty()) json.erase("extensions");
  if (json.empty())
    material.verbatim.erase(kept);
  else
    kept->second = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  return transform;
}

/// The same of the options of an MTL, in which v is counted from below.
std::optional<UvTransform> takeOfMtl(Material& material, const TextureUse& use) {
  const auto kept = material.verbatim.find("mtl:" + use.role);
  if (kept == material.verbatim.end()) return std::nullopt;
  const MtlPlacing placing = mtlPlacingOf(kept->second);
  if (!placing.isMoved()) return std::nullopt;
  std::string others = withoutMtlPlacing(kept->second);
  if (others.empty())
    material.verbatim.erase(kept);
  else
    kept->second = std::move(others);
  return UvTransform{.offset = {placing.offset[0], 1 - placing.scale[1] - placing.offset[1]},
                     .scale = placing.scale};
}

Transforms transformsOf(Material& material, bool alsoOfMtl, std::vector<std::string>& lost) {
  Transforms chosen;
  std::map<std::uint32_t, std::vector<std::pair<std::string, UvTransform>>> uses;
  for (TextureUse& use : material.textures) {
    std::optional<UvTransform> stated = take(material, use);
    if (!stated && alsoOfMtl) stated = takeOfMtl(material, use);
    const UvTransform transform = stated.value_or(UvTransform{});
    auto& of = uses[use.textureCoords];
    of.insert(use.role == "baseColor" ? of.begin() : of.end(), {use.role, transform});
  }
  std::string others;
  for (const auto& [set, of] : uses) {
    if (of.front().second != UvTransform{}) chosen[set] = of.front().second;
    for (const auto& [role, transform] : of)
      if (transform != of.front().second) others += (others.empty() ? "" : ", ") + text::quotedToken(role);
  }
  if (!others.empty())
    lost.push_back(
        fmt::format("the textures of material {} are placed in several ways on one set of "
                    "coordinates; those of {} lose theirs",
                    text::quotedToken(material.name), text::printable(others, 200)));
  return chosen;
}

std::string setName(std::uint32_t set) {
  return std::string(kTexcoordName) + (set == 0 ? "" : std::to_string(set));
}

/// @param classOf By element of the attributes; MeshAttributes::kNone: it stays.
void apply(std::vector<Attribute>& attributes, const std::vector<std::uint32_t>& classOf,
           const std::vector<Transforms>& classes) {
  for (Attribute& attribute : attributes) {
    if (attribute.meaning != AttributeMeaning::textureCoords || attribute.components != 2) continue;
    std::vector<const UvTransform*> ofClass(classes.size(), nullptr);
    bool changes = false;
    for (std::size_t k = 0; k < classes.size(); ++k)
      for (const auto& [set, transform] : classes[k])
        if (setName(set) == attribute.name) {
          ofClass[k] = &transform;
          changes = true;
        }
    if (!changes) continue;
    Attribute to = emptyLike(attribute);
    to.type = ScalarType::float32;
    to.isNormalized = false;
    const double largest = !attribute.isNormalized                ? 1
                           : attribute.type == ScalarType::uint8  ? 255
                           : attribute.type == ScalarType::uint16 ? 65535
                           : attribute.type == ScalarType::int8   ? 127
                                                                  : 32767;
    for (std::size_t i = 0; i < classOf.size(); ++i) {
      std::vector<double> uv = attribute.numbers(i);
      for (double& value : uv) value = attribute.isNormalized ? std::max(value / largest, -1.0) : value;
      if (const UvTransform* const transform =
              classOf[i] == MeshAttributes::kNone ? nullptr : ofClass[classOf[i]]) {
        const double down = attribute.isFromTop ? uv[1] : 1 - uv[1];
        const auto moved = (*transform)(uv[0], down);
        uv = {moved[0], attribute.isFromTop ? moved[1] : 1 - moved[1]};
      }
      to.append(uv);
    }
    attribute = std::move(to);
  }
}

/// The class of each vertex; nothing if a vertex is of several.
std::optional<std::vector<std::uint32_t>> classesOfVertices(const SurfaceMesh& mesh,
                                                            const std::vector<std::uint32_t>& classOf) {
  std::vector<std::uint32_t> result(mesh.positions.size(), MeshAttributes::kNone);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (result[v] != MeshAttributes::kNone && result[v] != classOf[t]) return std::nullopt;
      result[v] = classOf[t];
    }
  return result;
}

/// Splits wedges so that each is of one class.
std::vector<std::uint32_t> classesOfWedges(SurfaceMesh& mesh, const std::vector<std::uint32_t>& classOf) {
  std::vector<std::uint32_t> result(mesh.wedgeCount, MeshAttributes::kNone);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> copies;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t& wedge : mesh.wedges[t]) {
      if (result[wedge] == MeshAttributes::kNone) result[wedge] = classOf[t];
      if (result[wedge] == classOf[t]) continue;
      const auto [copy, isNew] = copies.try_emplace({wedge, classOf[t]}, mesh.wedgeCount);
      if (isNew) {
        ++mesh.wedgeCount;
        result.push_back(classOf[t]);
        for (Attribute& attribute : mesh.wedgeAttributes) {
          const auto element = attribute.element(wedge);
          const std::vector<std::byte> bytes(element.begin(), element.end());
          attribute.append(std::span(bytes));
        }
      }
      wedge = copy->second;
    }
  return result;
}

}  // namespace

bool hasTextureTransforms(const MeshAttributes& mesh, bool alsoOfMtl) {
  const auto isOne = [&](const auto& kept) {
    const auto& [key, text] = kept;
    return (key.starts_with("gltf:") && text.find(kExtension) != std::string::npos) ||
           (alsoOfMtl && key.starts_with("mtl:") && mtlPlacingOf(text).isMoved());
  };
  return std::ranges::any_of(mesh.materials, [&](const Material& material) {
    return std::ranges::any_of(material.verbatim, isOne);
  });
}

std::vector<std::string> applyTextureTransforms(SurfaceMesh& mesh, bool alsoOfMtl) {
  std::vector<std::string> lost;
  std::vector<Transforms> classes{{}};  // the first: no transform
  std::vector<std::uint32_t> classOfMaterial;
  std::map<Transforms, std::uint32_t> known{{{}, 0}};
  for (Material& material : mesh.materials) {
    const Transforms transforms = transformsOf(material, alsoOfMtl, lost);
    const auto [same, isNew] = known.try_emplace(transforms, static_cast<std::uint32_t>(classes.size()));
    if (isNew) classes.push_back(transforms);
    classOfMaterial.push_back(same->second);
  }
  if (classes.size() == 1 || mesh.materialOf.empty()) return lost;
  std::vector<std::uint32_t> classOf;
  for (const std::uint32_t material : mesh.materialOf)
    classOf.push_back(material == MeshAttributes::kNone ? 0 : classOfMaterial[material]);
  const auto isOfWedges = [](const Attribute& a) { return a.meaning == AttributeMeaning::textureCoords; };
  if (!std::ranges::any_of(mesh.wedgeAttributes, isOfWedges))
    if (const auto ofVertices = classesOfVertices(mesh, classOf)) {
      apply(mesh.vertexAttributes, *ofVertices, classes);
      return lost;
    }
  moveToWedges(mesh);
  const std::vector<std::uint32_t> ofWedges = classesOfWedges(mesh, classOf);
  apply(mesh.wedgeAttributes, ofWedges, classes);
  return lost;
}

}  // namespace arete
