// SPDX-License-Identifier: GPL-3.0-or-later
//
// A role names the place of a texture: one of the five of the standard, or the extension and the key of a
// texture in an extension, "extensions/KHR_materials_clearcoat/clearcoatTexture". Of an MTL, four keys have a
// place. References to textures that the statements of another glTF still have would name other textures
// here; they are removed.
#include "io/formats/glb/writer/materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "io/files/text_scan.h"
#include "io/formats/glb/texture_options.h"
#include "io/formats/glb/writer/mtl_material.h"

namespace arete {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kDeepest = 64;

/// Whether brackets nest deeper than is walked here; brackets in strings count too.
bool nestsDeeply(std::string_view text) {
  int depth = 0;
  for (const char c : text) {
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > kDeepest) return true;
  }
  return false;
}

/// An object from text, whose extensions are objects; empty if it is something else.
Json objectOf(const std::map<std::string, std::string>& texts, const std::string& key) {
  const auto found = texts.find(key);
  if (found == texts.end() || nestsDeeply(found->second)) return Json::object();
  Json json = Json::parse(found->second, nullptr, false);
  if (!json.is_object()) return Json::object();
  if (json.contains("extensions")) {
    Json objects = Json::object();
    for (const auto& [name, extension] : json["extensions"].items())
      if (json["extensions"].is_object() && extension.is_object()) objects[name] = extension;
    json["extensions"] = std::move(objects);
    if (json["extensions"].empty()) json.erase("extensions");
  }
  return json;
}

/// Removes references to textures.
void removeReferences(Json& json) {
  if (!json.is_structured()) return;
  for (auto it = json.begin(); it != json.end();) {
    const bool isReference =
        json.is_object() && it.key().ends_with("Texture") && it->is_object() && it->contains("index");
    if (isReference) {
      it = json.erase(it);
      continue;
    }
    removeReferences(*it);
    ++it;
  }
}

/// The place of a texture in a material; null if it has none.
Json* placeOf(Json& material, std::string_view role) {
  if (role == "baseColor" || role == "map_Kd") return &material["pbrMetallicRoughness"]["baseColorTexture"];
  if (role == "metallicRoughness") return &material["pbrMetallicRoughness"]["metallicRoughnessTexture"];
  if (role == "normal" || role == "norm") return &material["normalTexture"];
  if (role == "occlusion") return &material["occlusionTexture"];
  if (role == "emissive" || role == "map_Ke") return &material["emissiveTexture"];
  constexpr std::string_view kExtensions = "extensions/";
  if (!role.starts_with(kExtensions)) return nullptr;
  role.remove_prefix(kExtensions.size());
  const std::size_t slash = role.find('/');
  if (slash != std::string_view::npos && slash > 0 && slash + 1 < role.size())
    return &material["extensions"][std::string(role.substr(0, slash))][std::string(role.substr(slash + 1))];
  return nullptr;
}

class Writer {
 public:
  Writer(const MeshAttributes& mesh, const std::filesystem::path& folder,
         const std::map<std::uint32_t, std::uint32_t>& sets)
      : mesh_(mesh), sets_(sets), textures_(mesh, folder) {}

  WrittenMaterials write() {
    for (const Material& material : mesh_.materials) out_.materials.push_back(jsonOf(material));
    const auto addLost = [&](const std::set<std::string>& names, const char* what) {
      if (!names.empty()) out_.lost.push_back(fmt::format("{} ({})", what, fmt::join(names, ", ")));
    };
    addLost(statements_, "statements of materials");
    addLost(roles_, "textures of materials");
    addLost(withoutCoords_, "textures without texture coordinates");
    addLost(options_, "options of textures");
    for (const std::string& what : textures_.lost()) out_.lost.push_back(what);
    out_.textures = textures_.textures();
    out_.samplers = textures_.samplers();
    out_.required = textures_.extensions();
    out_.pictures = textures_.takePictures();
    return std::move(out_);
  }

 private:
  Json jsonOf(const Material& material) {
    Json json = Json::object();
    if (!material.name.empty()) json["name"] = material.name;
    const bool isGltf = material.verbatim.contains("gltf"), isMtl = material.verbatim.contains("mtl");
    Json kept = objectOf(material.verbatim, "gltf");
    removeReferences(kept);
    for (const char* member : {"name", "alphaMode", "alphaCutoff", "doubleSided"}) kept.erase(member);
    json.update(kept);
    if (!json.contains("pbrMetallicRoughness") || !json["pbrMetallicRoughness"].is_object())
      json["pbrMetallicRoughness"] = Json::object();
    Json& surface = json["pbrMetallicRoughness"];
    std::array<double, 4> color = material.baseColor;
    for (double& part : color) part = part > 0 ? std::min(part, 1.0) : 0;
    if (color != material.baseColor) statements_.insert("base colours below 0 or above 1");
    surface.erase("baseColorFactor");
    if (color != std::array<double, 4>{1, 1, 1, 1}) surface["baseColorFactor"] = color;
    if (!isGltf) addMtlStatements(isMtl ? material.verbatim.at("mtl") : "", json, statements_);
    if (isGltf && isMtl) statements_.insert("of MTL");
    for (const TextureUse& use : material.textures) addTexture(material, use, json);
    if (json["pbrMetallicRoughness"].empty()) json.erase("pbrMetallicRoughness");
    // An MTL has a number for alpha and no mode.
    const bool isBlended = isMtl && !isGltf && material.baseColor[3] < 1 && material.alphaMode == "OPAQUE";
    const std::string mode = isBlended ? "BLEND" : material.alphaMode;
    if (mode == "MASK" || mode == "BLEND") json["alphaMode"] = mode;
    if (mode == "MASK" && material.alphaCutoff != 0.5 && material.alphaCutoff >= 0)
      json["alphaCutoff"] = material.alphaCutoff;
    if (material.isDoubleSided) json["doubleSided"] = true;
    if (const auto extensions = json.find("extensions"); extensions != json.end() && extensions->is_object())
      for (const auto& [name, unused] : extensions->items()) out_.extensions.insert(name);
    return json;
  }

  void addTexture(const Material& material, const TextureUse& use, Json& json) {
    Json nowhere = Json::object();
    if (placeOf(nowhere, use.role) == nullptr) {
      roles_.insert(use.role);
      return;
    }
    const auto set = sets_.find(use.textureCoords);
    if (set == sets_.end()) {
      withoutCoords_.insert(text::quotedToken(material.name));
      return;
    }
    Json info = objectOf(material.verbatim, "gltf:" + use.role);
    Json sampler = info.contains("sampler") ? info["sampler"] : Json();
    const auto mtl = material.verbatim.find("mtl:" + use.role);
    const MtlPlacing placing = mtl == material.verbatim.end() ? MtlPlacing{} : mtlPlacingOf(mtl->second);
    constexpr int kClampToEdge = 33071;
    if (placing.clamps && sampler.is_null()) sampler = {{"wrapS", kClampToEdge}, {"wrapT", kClampToEdge}};
    const auto texture = textures_.texture(use.picture, sampler);
    if (!texture) return;
    addOptions(use.role, placing, info);
    for (const char* member : {"sampler", "index", "texCoord"}) info.erase(member);
    Json reference = {{"index", *texture}};
    if (set->second != 0) reference["texCoord"] = set->second;
    reference.update(info);
    if (const auto extensions = reference.find("extensions");
        extensions != reference.end() && extensions->is_object())
      for (const auto& [name, unused] : extensions->items()) out_.extensions.insert(name);
    *placeOf(json, use.role) = std::move(reference);
  }

  /// What an MTL says of the place of a texture. There v is counted from below, here from above.
  void addOptions(const std::string& role, const MtlPlacing& placing, Json& info) {
    constexpr const char* kTransform = "KHR_texture_transform";
    if (placing.isMoved() && !(info.contains("extensions") && info["extensions"].contains(kTransform))) {
      Json transform = Json::object();
      const std::array<double, 2> offset{placing.offset[0], 1 - placing.scale[1] - placing.offset[1]};
      if (offset != std::array{0.0, 0.0}) transform["offset"] = offset;
      if (placing.scale != std::array{1.0, 1.0}) transform["scale"] = placing.scale;
      info["extensions"][kTransform] = std::move(transform);
    }
    std::string others = placing.others;
    if (placing.bump && *placing.bump != 1) {
      if ((role == "normal" || role == "norm") && !info.contains("scale"))
        info["scale"] = *placing.bump;
      else
        others += fmt::format("{}-bm {}", others.empty() ? "" : " ", *placing.bump);
    }
    if (!others.empty()) options_.insert(others);
  }

  const MeshAttributes& mesh_;
  const std::map<std::uint32_t, std::uint32_t>& sets_;
  GltfTextures textures_;
  WrittenMaterials out_;
  std::set<std::string> statements_, roles_, withoutCoords_, options_;
};

}  // namespace

WrittenMaterials writtenMaterials(const MeshAttributes& mesh, const std::filesystem::path& folder,
                                  const std::map<std::uint32_t, std::uint32_t>& textureSets) {
  return Writer(mesh, folder, textureSets).write();
}

}  // namespace arete
