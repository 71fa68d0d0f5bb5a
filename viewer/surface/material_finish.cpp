// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sense in which KHR_texture_transform turns is explained in io/formats/glb/texture_transform.cpp.
#include "viewer/surface/material_finish.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/files/number_text.h"
#include "io/formats/glb/texture_options.h"

namespace arete {
namespace {

using FinishJson = nlohmann::json;

FinishJson keptJson(const Material& material, const std::string& key) {
  const auto kept = material.verbatim.find(key);
  if (kept == material.verbatim.end()) return FinishJson::object();
  FinishJson json = FinishJson::parse(kept->second, nullptr, false);
  return json.is_object() ? json : FinishJson::object();
}

/// A number at a place in the JSON, within a range.
double numberAt(const FinishJson& json, const char* place, double otherwise, double least, double most) {
  const FinishJson::json_pointer pointer(place);
  if (!json.contains(pointer) || !json[pointer].is_number()) return otherwise;
  return std::clamp(json[pointer].get<double>(), least, most);
}

std::optional<std::vector<double>> numbersAt(const FinishJson& json, const char* place, std::size_t count) {
  const FinishJson::json_pointer pointer(place);
  if (!json.contains(pointer) || !json[pointer].is_array() || json[pointer].size() != count)
    return std::nullopt;
  std::vector<double> numbers;
  for (const FinishJson& n : json[pointer]) {
    if (!n.is_number()) return std::nullopt;
    numbers.push_back(n);
  }
  return numbers;
}

glm::vec3 emissionFrom(const std::vector<double>& c, double strength) {
  const auto part = [&](double x) { return float(std::max(0.0, x) * strength); };
  return {part(c[0]), part(c[1]), part(c[2])};
}

/// The numbers of the last statement of a keyword in the lines that an MTL states: one or three, as colours
/// are.
std::optional<std::vector<double>> mtlNumbers(const Material& material, std::string_view keyword) {
  const auto kept = material.verbatim.find("mtl");
  if (kept == material.verbatim.end()) return std::nullopt;
  std::optional<std::vector<double>> last;
  std::string_view text = kept->second;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    std::vector<std::string_view> words;
    while (!line.empty()) {
      const std::size_t from = line.find_first_not_of(" \t\r");
      if (from == std::string_view::npos || line[from] == '#') break;
      line.remove_prefix(from);
      const std::size_t length = std::min(line.find_first_of(" \t\r"), line.size());
      words.push_back(line.substr(0, length));
      line.remove_prefix(length);
    }
    if ((words.size() != 2 && words.size() != 4) || words[0] != keyword) continue;
    std::vector<double> numbers;
    for (std::size_t i = 1; i < words.size(); ++i)
      if (const auto n = text::parseNumber(words[i]); n && std::isfinite(*n)) numbers.push_back(*n);
    if (numbers.size() + 1 != words.size()) continue;
    if (numbers.size() == 1) numbers.resize(3, numbers[0]);
    last = numbers;
  }
  return last;
}

MaterialFinish finishOfMtl(const Material& material) {
  MaterialFinish finish;
  const bool hasPicture = textureOfRole(material, {"metallicRoughness"}) != nullptr;
  const auto metal = mtlNumbers(material, "Pm"), roughness = mtlNumbers(material, "Pr"),
             shine = mtlNumbers(material, "Ns"), gloss = mtlNumbers(material, "Ks"),
             model = mtlNumbers(material, "illum"), emission = mtlNumbers(material, "Ke");
  const bool isMatt = model && model->front() < 2;
  const double mean = gloss ? ((*gloss)[0] + (*gloss)[1] + (*gloss)[2]) / 3 : 0;
  if (metal || roughness || hasPicture) {
    finish.metal = metal ? float(std::clamp(metal->front(), 0.0, 1.0)) : hasPicture ? 1.0f : 0.0f;
    finish.roughness = roughness ? float(std::clamp(roughness->front(), 0.0, 1.0)) : 1.0f;
    finish.reflectance = 0.04f;
  } else if (!isMatt && mean > 0) {
    finish.reflectance = float(0.08 * std::clamp(mean, 0.0, 1.0));
    finish.roughness = float(std::sqrt(2 / (2 + std::max(0.0, shine ? shine->front() : 0.0))));
  }
  if (emission) finish.emission = emissionFrom(*emission, 1);
  // A picture of emission beside no Ke is shown as it is.
  if (!emission && textureOfRole(material, {"emissive"})) finish.emission = glm::vec3(1);
  return finish;
}

}  // namespace

const TextureUse* textureOfRole(const Material& material, std::initializer_list<std::string_view> roles) {
  for (const std::string_view role : roles) {
    const auto found = std::ranges::find(material.textures, role, &TextureUse::role);
    if (found != material.textures.end()) return &*found;
  }
  return nullptr;
}

MaterialFinish finishOf(const Material& material, bool isOfGltf) {
  if (!isOfGltf) return finishOfMtl(material);
  const FinishJson json = keptJson(material, "gltf");
  MaterialFinish finish;
  finish.metal = float(numberAt(json, "/pbrMetallicRoughness/metallicFactor", 1, 0, 1));
  finish.roughness = float(numberAt(json, "/pbrMetallicRoughness/roughnessFactor", 1, 0, 1));
  const double index = numberAt(json, "/extensions/KHR_materials_ior/ior", 1.5, 1, 100);
  finish.reflectance = float(std::pow((index - 1) / (index + 1), 2));
  if (const auto factor = numbersAt(json, "/emissiveFactor", 3))
    finish.emission = emissionFrom(
        *factor, numberAt(json, "/extensions/KHR_materials_emissive_strength/emissiveStrength", 1, 0, 1e6));
  finish.normalScale = float(numberAt(keptJson(material, "gltf:normal"), "/scale", 1, -100, 100));
  finish.occlusion = float(numberAt(keptJson(material, "gltf:occlusion"), "/strength", 1, 0, 1));
  finish.isWithoutLight = json.contains(FinishJson::json_pointer("/extensions/KHR_materials_unlit"));
  return finish;
}

PictureLookup lookupOf(const Material& material, const TextureUse& use) {
  PictureLookup lookup;
  lookup.textureCoords = use.textureCoords;
  if (const auto kept = material.verbatim.find("mtl:" + use.role); kept != material.verbatim.end()) {
    const MtlPlacing placing = mtlPlacingOf(kept->second);
    lookup.u = {float(placing.scale[0]), 0, float(placing.offset[0])};
    lookup.v = {0, float(placing.scale[1]), float(1 - placing.scale[1] - placing.offset[1])};
    if (placing.clamps) lookup.acrossU = lookup.acrossV = PictureLookup::Wrap::clamp;
    return lookup;
  }
  const FinishJson json = keptJson(material, "gltf:" + use.role);
  const char* const transform = "/extensions/KHR_texture_transform";
  if (json.contains(FinishJson::json_pointer(transform))) {
    const std::string place = transform;
    const auto offset = numbersAt(json, (place + "/offset").c_str(), 2),
               scale = numbersAt(json, (place + "/scale").c_str(), 2);
    const double turn = numberAt(json, (place + "/rotation").c_str(), 0, -1e6, 1e6);
    const double c = std::cos(turn), s = std::sin(turn), x = scale ? (*scale)[0] : 1,
                 y = scale ? (*scale)[1] : 1;
    lookup.u = {float(c * x), float(s * y), offset ? float((*offset)[0]) : 0};
    lookup.v = {float(-s * x), float(c * y), offset ? float((*offset)[1]) : 0};
    lookup.textureCoords =
        std::uint32_t(numberAt(json, (place + "/texCoord").c_str(), lookup.textureCoords, 0, 0xFFFF));
  }
  const auto wrap = [&](const char* place) {
    const double stated = numberAt(json, place, 10497, 0, 1e6);
    return stated == 33071   ? PictureLookup::Wrap::clamp
           : stated == 33648 ? PictureLookup::Wrap::mirror
                             : PictureLookup::Wrap::repeat;
  };
  lookup.acrossU = wrap("/sampler/wrapS");
  lookup.acrossV = wrap("/sampler/wrapT");
  // NEAREST, and with mipmaps: NEAREST_MIPMAP_NEAREST, NEAREST_MIPMAP_LINEAR.
  const double shrunk = numberAt(json, "/sampler/minFilter", 9987, 0, 1e6);
  lookup.isNearest = numberAt(json, "/sampler/magFilter", 9729, 0, 1e6) == 9728;
  lookup.isNearestFar = shrunk == 9728 || shrunk == 9984 || shrunk == 9986;
  lookup.hasLevels = shrunk != 9728 && shrunk != 9729;
  return lookup;
}

}  // namespace arete
