// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a material keeps of an MTL is written again. Of a material that came from glTF instead, the numbers
// that MTL knows are taken from its JSON, and the rest is named.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "io/files/text_scan.h"
#include "io/formats/obj/mtl.h"

namespace arete {
namespace {

using nlohmann::json;

constexpr std::size_t kMostNamesListed = 8;

/// What is lost of several materials: "the alpha mode of materials (\"a\", \"b\")".
class Losses {
 public:
  void add(const std::string& what, const std::string& material) {
    std::vector<std::string>& names = of_[what];
    if (names.empty() || names.back() != material) names.push_back(material);
  }
  std::vector<std::string> texts() const {
    std::vector<std::string> texts;
    for (const auto& [what, names] : of_) {
      std::string list;
      for (std::size_t i = 0; i < std::min(names.size(), kMostNamesListed); ++i)
        list += (i == 0 ? "" : ", ") + text::quotedToken(names[i]);
      if (names.size() > kMostNamesListed)
        list += fmt::format(" and {} more", names.size() - kMostNamesListed);
      texts.push_back(fmt::format("{} of materials ({})", what, list));
    }
    return texts;
  }

 private:
  std::map<std::string, std::vector<std::string>> of_;
};

const std::string* verbatimOf(const Material& material, const std::string& key) {
  const auto found = material.verbatim.find(key);
  return found == material.verbatim.end() || found->second.empty() ? nullptr : &found->second;
}

/// The statements that stand for what a material from glTF has beyond Material's fields.
class GltfStatements {
 public:
  GltfStatements(const Material& material, Losses& losses) : name_(material.name), losses_(losses) {
    const std::string* const verbatim = verbatimOf(material, "gltf");
    if (!verbatim) return;
    json members = json::parse(*verbatim, nullptr, false);
    if (!members.is_object()) {
      losses_.add("glTF's own members", name_);
      return;
    }
    // The factors are members of the material or of its pbrMetallicRoughness.
    if (const auto pbr = members.find("pbrMetallicRoughness"); pbr != members.end() && pbr->is_object()) {
      const json inner = *pbr;
      members.erase(pbr);
      takeFactors(inner, true);
    }
    takeFactors(members, false);
  }

  const std::string& text() const { return text_; }

 private:
  void takeFactors(const json& members, bool isPbr) {
    for (const auto& [key, value] : members.items()) {
      if (key == "metallicFactor" && value.is_number()) {
        text_ += fmt::format("Pm {}\n", value.get<double>());
      } else if (key == "roughnessFactor" && value.is_number()) {
        text_ += fmt::format("Pr {}\n", value.get<double>());
      } else if (key == "emissiveFactor" && isColor(value)) {
        text_ += fmt::format("Ke {} {} {}\n", value[0].get<double>(), value[1].get<double>(),
                             value[2].get<double>());
      } else {
        losses_.add(fmt::format("{}{}", isPbr ? "pbrMetallicRoughness." : "", text::printable(key, 40)),
                    name_);
      }
    }
  }
  static bool isColor(const json& value) {
    return value.is_array() && value.size() == 3 &&
           std::ranges::all_of(value, [](const json& v) { return v.is_number(); });
  }

  const std::string& name_;
  Losses& losses_;
  std::string text_;
};

/// The keywords that state a texture, each with what is written between it and the picture.
struct Statement {
  std::string keyword, options;
};

std::vector<Statement> statementsOf(const std::string& role, const std::string& options) {
  if (role == "baseColor") return {{"map_Kd", options}};
  if (role == "normal") return {{"norm", options}, {"map_Bump", options}};
  if (role == "emissive") return {{"map_Ke", options}};
  if (role == "metallicRoughness") return {{"map_Pr", "-imfchan g"}, {"map_Pm", "-imfchan b"}};
  if (mtlTextureRole(role) != role) return {};  // no keyword of MTL
  return {{role, options}};
}

bool isBump(const std::string& role) {
  const std::string lower = text::lowered(role);
  return lower == "map_bump" || lower == "bump";
}

class MtlWriter {
 public:
  explicit MtlWriter(const PicturePath& path) : path_(path) {}

  Status write(const Material& material, const std::string& name) {
    result_.text += fmt::format("\nnewmtl {}\n", name);
    const auto& c = material.baseColor;
    result_.text += fmt::format("Kd {} {} {}\n", c[0], c[1], c[2]);
    if (c[3] != 1) result_.text += fmt::format("d {}\n", c[3]);
    if (const std::string* const kept = verbatimOf(material, "mtl")) {
      result_.text += *kept + "\n";
    } else {
      result_.text += GltfStatements(material, losses_).text();
    }
    // A role may occur several times; all but the first have numbers in their keys.
    std::map<std::string, int> uses;
    for (const TextureUse& use : material.textures)
      ARETE_CHECK(writeTexture(material, use, uses[use.role]++));
    nameLosses(material);
    return {};
  }

  MtlText finish() {
    result_.lost = losses_.texts();
    return std::move(result_);
  }

 private:
  Status writeTexture(const Material& material, const TextureUse& use, int earlier) {
    std::string key = "mtl:" + use.role;
    if (earlier > 0) key += fmt::format("#{}", earlier);
    const std::string* const options = verbatimOf(material, key);
    const std::vector<Statement> statements =
        statementsOf(text::onOneLine(use.role), options ? text::onOneLine(*options) : std::string());
    if (statements.empty()) {
      losses_.add(fmt::format("{} textures", text::printable(use.role, 40)), material.name);
      return {};
    }
    if (use.textureCoords != 0) losses_.add("which texture coordinates textures use", material.name);
    if (verbatimOf(material, "gltf:" + use.role))
      losses_.add("samplers and transforms of textures", material.name);
    ARETE_TRY(const std::string path, path_(use.picture));
    if (path.empty()) return {};
    // A bump map of the material's own replaces the one that a normal texture would be written as.
    const bool hasBump =
        std::ranges::any_of(material.textures, [](const TextureUse& other) { return isBump(other.role); });
    for (const auto& [keyword, between] : statements) {
      if (use.role == "normal" && isBump(keyword) && hasBump) continue;
      result_.text += fmt::format("{}{}{} {}\n", keyword, between.empty() ? "" : " ", between, path);
    }
    return {};
  }

  void nameLosses(const Material& material) {
    // MTL has no alpha mode: "d" and "map_d" imply one.
    const bool hasAlphaMap = std::ranges::any_of(
        material.textures, [](const TextureUse& use) { return text::lowered(use.role) == "map_d"; });
    const std::string implied = material.baseColor[3] < 1 || hasAlphaMap ? "BLEND" : "OPAQUE";
    if (material.alphaMode != implied)
      losses_.add(fmt::format("alpha mode {}", text::printable(material.alphaMode, 40)), material.name);
    if (material.isDoubleSided) losses_.add("double sides", material.name);
  }

  const PicturePath& path_;
  MtlText result_;
  Losses losses_;
};

}  // namespace

std::vector<std::string> mtlNames(std::span<const Material> materials) {
  std::set<std::string> taken;
  std::map<std::string, int> next;  // number to try behind a name
  std::vector<std::string> names;
  for (const Material& material : materials) {
    std::string name = text::onOneLine(material.name);
    while (!name.empty() && text::isBlank(name.front())) name.erase(0, 1);
    while (!name.empty() && text::isBlank(name.back())) name.pop_back();
    if (name.empty()) name = "material";
    std::string own = name;
    while (!taken.insert(own).second) own = fmt::format("{}-{}", name, ++next[name]);
    names.push_back(std::move(own));
  }
  return names;
}

Result<MtlText> mtlText(std::span<const Material> materials, std::span<const std::string> names,
                        const PicturePath& path) {
  MtlWriter writer(path);
  for (std::size_t i = 0; i < materials.size(); ++i) ARETE_CHECK(writer.write(materials[i], names[i]));
  return writer.finish();
}

}  // namespace arete
