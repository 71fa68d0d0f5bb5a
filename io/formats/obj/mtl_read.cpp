// SPDX-License-Identifier: GPL-3.0-or-later
//
// Line by line. A statement that names a picture may have options before the name, and in some files behind
// it, and the name may have blanks; so what is left between the options is the name.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "engine/base/counted.h"
#include "io/files/number_text.h"
#include "io/files/text/utf8.h"
#include "io/files/text_scan.h"
#include "io/formats/obj/mtl.h"

namespace arete {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text::isSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && text::isSpace(text.back())) text.remove_suffix(1);
  return text;
}

/// Takes the first word of a text, and the blanks around it.
std::string_view takeWord(std::string_view& text) {
  text = trimmed(text);
  const auto end = static_cast<std::size_t>(std::ranges::find_if(text, text::isSpace) - text.begin());
  const std::string_view word = text.substr(0, end);
  text = trimmed(text.substr(end));
  return word;
}

bool isNumber(std::string_view word) {
  return text::parseNumber(word).has_value();
}

/// How many values an option of a texture has; -1: it is no option, -3: one to three numbers.
int valuesOf(std::string_view option) {
  if (option == "-o" || option == "-s" || option == "-t") return -3;
  if (option == "-mm") return 2;
  for (const std::string_view known : {"-blendu", "-blendv", "-bm", "-boost", "-cc", "-clamp", "-colorspace",
                                       "-imfchan", "-texres", "-type"})
    if (option == known) return 1;
  return -1;
}

/// Takes the options that a text begins with. The last word is left where it may be the name of the picture.
std::string_view takeOptions(std::string_view& text, bool isBeforeName) {
  const std::string_view whole = text = trimmed(text);
  std::string_view rest = text;
  for (;;) {
    std::string_view at = rest;
    const int values = valuesOf(takeWord(at));
    if (values == -1) break;
    for (int taken = 0; taken < std::abs(values) && !at.empty(); ++taken) {
      std::string_view behind = at;
      const std::string_view value = takeWord(behind);
      const bool mustBeNumber = values != 1;
      if ((mustBeNumber && !isNumber(value)) || (isBeforeName && behind.empty())) break;
      at = behind;
    }
    rest = at;
  }
  text = rest;
  return trimmed(whole.substr(0, whole.size() - rest.size()));
}

/// There are a dozen of them.
constexpr int kMostOptions = 16;
/// MTL knows some twenty; further ones are kept as lines.
constexpr std::size_t kMostTextures = 64;
/// A material takes many times the bytes of its line.
constexpr std::size_t kMostMaterials = 1 << 20;

struct TextureStatement {
  std::string picture, options;
};

TextureStatement textureOf(std::string_view rest) {
  TextureStatement statement;
  statement.options = takeOptions(rest, true);
  int tries = 0;
  for (std::size_t at = rest.find(" -"); at != std::string_view::npos && tries < kMostOptions;
       at = rest.find(" -", at + 1), ++tries) {
    std::string_view behind = rest.substr(at);
    const std::string_view options = takeOptions(behind, false);
    if (!behind.empty()) continue;
    statement.options += (statement.options.empty() ? "" : " ") + std::string(options);
    rest = trimmed(rest.substr(0, at));
    break;
  }
  if (rest.size() > 1 && rest.front() == '"' && rest.back() == '"') rest = rest.substr(1, rest.size() - 2);
  statement.picture = rest;
  return statement;
}

}  // namespace

std::string mtlTextureRole(std::string_view keyword) {
  const std::string lower = text::lowered(keyword);
  if (lower == "map_kd") return "baseColor";
  if (lower == "norm" || lower == "map_kn") return "normal";
  if (lower == "map_ke") return "emissive";
  if (lower == "map_aat") return {};  // "on" or "off"
  const bool isTexture =
      lower.starts_with("map_") || lower == "bump" || lower == "disp" || lower == "decal" || lower == "refl";
  return isTexture ? std::string(keyword) : std::string();
}

namespace {

class MtlReader {
 public:
  MtlMaterials read(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      takeLine(trimmed(text.substr(0, end)));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    // The end of the file ends the last material.
    endMaterial();
    if (strays_ > 0)
      result_.warnings.push_back(
          {WarningCode::omitted, counted(strays_, "statement before its first material is left out",
                                         "statements before its first material are left out")});
    if (doubles_ > 0)
      result_.warnings.push_back(
          {WarningCode::omitted, fmt::format("{} of its materials {} left out (the first is {})", doubles_,
                                             agreeing(doubles_, "has a name that an earlier one has, and is",
                                                      "have a name that an earlier one has, and are"),
                                             text::quotedToken(firstDouble_))});
    if (tooMany_ > 0)
      result_.warnings.push_back(
          {WarningCode::omitted, fmt::format("{} of its materials, beyond the first {}, {} left out",
                                             tooMany_, kMostMaterials, agreeing(tooMany_, "is", "are"))});
    if (replaced_ > 0)
      result_.warnings.push_back(
          {WarningCode::completed, fmt::format("{} stated twice for one material; the later one stays",
                                               counted(replaced_, "texture is", "textures are"))});
    return std::move(result_);
  }

 private:
  void takeLine(std::string_view line) {
    if (line.empty() || line.front() == '#') return;
    std::string_view rest = line;
    const std::string_view keyword = takeWord(rest);
    if (keyword == "newmtl") {
      endMaterial();
      material_.emplace();
      material_->name = text::asUtf8(rest);
      return;
    }
    if (!material_) {
      ++strays_;
      return;
    }
    // What a material has a member for is taken; every other statement is kept as text, to be written again.
    if ((keyword == "Kd" && takeBaseColor(rest)) || (keyword == "d" && takeNumber(rest, dissolve_)) ||
        (keyword == "Tr" && takeNumber(rest, transparency_)))
      return;
    const std::string role = mtlTextureRole(keyword);
    if (!role.empty() && material_->textures.size() < kMostTextures)
      takeTexture(role, rest);
    else
      keep(line);
  }

  void keep(std::string_view line) {
    kept_ += kept_.empty() ? "" : "\n";
    kept_ += line;
  }

  /// False where the numbers are a spectral curve, or more or fewer than stand for a colour.
  bool takeBaseColor(std::string_view rest) {
    std::array<double, 3> color{};
    std::size_t count = 0;
    while (!rest.empty() && rest.front() != '#') {
      const auto number = text::parseNumber(takeWord(rest));
      if (!number || !std::isfinite(*number) || count == color.size()) return false;
      color[count++] = *number;
    }
    if (count != 1 && count != 3) return false;
    if (count == 1) color[1] = color[2] = color[0];
    std::ranges::copy(color, material_->baseColor.begin());
    return true;
  }

  static bool takeNumber(std::string_view rest, std::optional<double>& to) {
    const auto number = text::parseNumber(takeWord(rest));
    if (!number || !std::isfinite(*number) || (!rest.empty() && rest.front() != '#')) return false;
    to = *number;
    return true;
  }

  void takeTexture(const std::string& role, std::string_view rest) {
    TextureStatement statement = textureOf(rest);
    if (statement.picture.empty()) return;  // as exporters write it that know of no picture
    auto& textures = material_->textures;
    const auto sameRole = [&](const TextureUse& use) { return use.role == role; };
    std::string key = "mtl:" + role;
    // The sides of a cube that is reflected have a statement each.
    if (const auto known = std::ranges::count_if(textures, sameRole);
        known > 0 && text::lowered(role) == "refl") {
      key += fmt::format("#{}", known);
    } else if (known > 0) {
      std::erase_if(textures, sameRole);
      material_->verbatim.erase(key);
      ++replaced_;
    }
    textures.push_back({.role = role, .picture = std::move(statement.picture)});
    if (!statement.options.empty()) material_->verbatim[key] = std::move(statement.options);
  }

  /// Two statements that stand for one texture of glTF become one.
  void joinTextures() {
    auto& textures = material_->textures;
    auto& verbatim = material_->verbatim;
    const auto find = [&](std::string_view lowerRole) {
      return std::ranges::find_if(
          textures, [&](const TextureUse& use) { return text::lowered(use.role) == lowerRole; });
    };
    const auto optionsOf = [&](const TextureUse& use) {
      const auto found = verbatim.find("mtl:" + use.role);
      return found == verbatim.end() ? std::string() : found->second;
    };
    for (const char* bump : {"map_bump", "bump"}) {
      const auto normal = find("normal"), other = find(bump);
      if (normal == textures.end() || other == textures.end() || normal->picture != other->picture ||
          optionsOf(*normal) != optionsOf(*other))
        continue;
      verbatim.erase("mtl:" + other->role);
      textures.erase(other);
    }
    const auto roughness = find("map_pr"), metallic = find("map_pm");
    if (roughness == textures.end() || metallic == textures.end() ||
        roughness->picture != metallic->picture || optionsOf(*roughness) != "-imfchan g" ||
        optionsOf(*metallic) != "-imfchan b")
      return;
    verbatim.erase("mtl:" + roughness->role);
    verbatim.erase("mtl:" + metallic->role);
    roughness->role = "metallicRoughness";
    textures.erase(metallic);
  }

  /// Some programs write Tr for d, and "Tr 1" of what is opaque, as MeshLab did: no exporter has a material
  /// that cannot be seen. So Tr counts where there is no d and it leaves something to see.
  void takeAlpha() {
    if (dissolve_)
      material_->baseColor[3] = *dissolve_;
    else if (transparency_ && *transparency_ < 1)
      material_->baseColor[3] = 1 - *transparency_;
    if (transparency_ && material_->baseColor[3] != 1 - *transparency_)
      keep(fmt::format("Tr {}", *transparency_));
  }

  void endMaterial() {
    const bool isTooMany = result_.materials.size() == kMostMaterials;
    tooMany_ += material_ && isTooMany;
    if (isTooMany) {
      // Left out.
    } else if (material_ && names_.insert(material_->name).second) {
      takeAlpha();
      joinTextures();
      const bool hasAlphaMap = std::ranges::any_of(
          material_->textures, [](const TextureUse& use) { return text::lowered(use.role) == "map_d"; });
      if (material_->baseColor[3] < 1 || hasAlphaMap) material_->alphaMode = "BLEND";
      if (!kept_.empty()) material_->verbatim["mtl"] = std::move(kept_);
      result_.materials.push_back(std::move(*material_));
    } else if (material_ && doubles_++ == 0) {
      firstDouble_ = material_->name;
    }
    material_.reset();
    dissolve_.reset();
    transparency_.reset();
    kept_.clear();
  }

  MtlMaterials result_;
  std::optional<Material> material_;  // that is being read
  std::optional<double> dissolve_, transparency_;
  std::string kept_;
  std::set<std::string> names_;
  std::uint64_t strays_ = 0, doubles_ = 0, replaced_ = 0, tooMany_ = 0;
  std::string firstDouble_;
};

}  // namespace

MtlMaterials readMtl(std::string_view text) {
  return MtlReader().read(text);
}

}  // namespace arete
