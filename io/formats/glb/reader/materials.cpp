// SPDX-License-Identifier: GPL-3.0-or-later
//
// A texture names an image by "source"; extensions that bring further kinds of pictures name one of their
// own, and then "source" is for programs without the extension. It is taken if it is there.
#include "io/formats/glb/reader/materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "io/files/text_scan.h"
#include "io/formats/glb/buffers.h"
#include "io/formats/glb/extensions.h"
#include "io/formats/glb/reader/left_out.h"

namespace arete {

namespace {

using Json = nlohmann::json;

constexpr const char* kMetallicRoughness = "pbrMetallicRoughness";
/// Extensions of textures that name an image.
constexpr std::array<const char*, 4> kImageExtensions = {"KHR_texture_basisu", "EXT_texture_webp",
                                                         "EXT_texture_avif", "MSFT_texture_dds"};

std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string textOf(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// What the model has fields for is taken out of a copy of the JSON; what is left of the copy is kept
/// verbatim, so that a glTF written from the model can have it again.
class MaterialReader {
 public:
  explicit MaterialReader(const GltfDocument& document) : document_(document) {}

  void read() {
    const auto list = document_.json().find("materials");
    if (list == document_.json().end() || !list->is_array()) return;
    for (const Json& material : *list) result.materials.push_back(readMaterial(material));
    const auto images = document_.json().find("images");
    if (images == document_.json().end() || !images->is_array()) return;
    unusedImages = images->size();
    // Materials may name images that are not there.
    for (const auto& [image, picture] : pictures_)
      if (image < images->size()) --unusedImages;
  }

  GltfMaterials result;
  std::vector<std::string> problems;
  std::uint64_t unusedImages = 0, furtherPictures = 0;

 private:
  Material readMaterial(const Json& json) {
    Material material;
    if (!json.is_object()) {
      problems.emplace_back("a material is no object");
      return material;
    }
    Json rest = json;
    material.name = textOf(rest, "name");
    rest.erase("name");
    const auto damaged = [&](const char* what) {
      problems.push_back(
          fmt::format("material {} has a damaged \"{}\"", text::quotedToken(material.name), what));
    };
    // A damaged member costs a message and its default, and the rest of the material is read all the same.
    if (const auto found = rest.find("doubleSided"); found != rest.end()) {
      found->is_boolean() ? void(material.isDoubleSided = *found) : damaged("doubleSided");
      rest.erase("doubleSided");
    }
    if (const auto found = rest.find("alphaMode"); found != rest.end()) {
      if (*found == "OPAQUE" || *found == "MASK" || *found == "BLEND")
        material.alphaMode = *found;
      else
        damaged("alphaMode");
      rest.erase("alphaMode");
    }
    if (const auto found = rest.find("alphaCutoff"); found != rest.end()) {
      found->is_number() ? void(material.alphaCutoff = *found) : damaged("alphaCutoff");
      rest.erase("alphaCutoff");
    }
    if (const auto pbr = rest.find(kMetallicRoughness); pbr != rest.end() && pbr->is_object()) {
      if (const auto color = pbr->find("baseColorFactor"); color != pbr->end()) {
        bool isGood = color->is_array() && color->size() == 4;
        for (std::size_t c = 0; isGood && c < 4; ++c) isGood = (*color)[c].is_number();
        for (std::size_t c = 0; isGood && c < 4; ++c) material.baseColor[c] = (*color)[c];
        if (!isGood) damaged("baseColorFactor");
        pbr->erase("baseColorFactor");
      }
      takeTexture(*pbr, "baseColorTexture", "baseColor", material);
      takeTexture(*pbr, "metallicRoughnessTexture", "metallicRoughness", material);
      if (pbr->empty()) rest.erase(kMetallicRoughness);
    }
    takeTexture(rest, "normalTexture", "normal", material);
    takeTexture(rest, "occlusionTexture", "occlusion", material);
    takeTexture(rest, "emissiveTexture", "emissive", material);
    // Extensions have textures of their own. They are listed before any is taken, since taking one changes
    // the object that is walked through.
    if (const auto extensions = rest.find("extensions"); extensions != rest.end() && extensions->is_object())
      for (auto& [name, extension] : extensions->items()) {
        if (!extension.is_object()) continue;
        std::vector<std::string> textures;
        for (const auto& [key, value] : extension.items())
          if (key.ends_with("Texture") && value.is_object() && value.contains("index"))
            textures.push_back(key);
        for (const std::string& key : textures)
          takeTexture(extension, key, fmt::format("extensions/{}/{}", name, key), material);
      }
    if (!rest.empty()) material.verbatim["gltf"] = dumped(rest);
    return material;
  }

  /// Moves a texture from the JSON to the material.
  void takeTexture(Json& object, const std::string& key, const std::string& role, Material& material) {
    const auto found = object.find(key);
    if (found == object.end()) return;
    Json use = std::move(*found);
    object.erase(found);
    const auto lost = [&](std::string_view reason) {
      problems.push_back(fmt::format("material {} is without its texture {}: {}",
                                     text::quotedToken(material.name), text::quotedToken(role), reason));
    };
    // A texture that cannot be read leaves the material without it; the problem names the material and the
    // role.
    if (!use.is_object()) return lost("it is no object");
    const auto number = GltfDocument::wholeNumber(use, "index"),
               set = GltfDocument::wholeNumber(use, "texCoord", 0);
    if (!number) return lost(number.error().message);
    if (!set) return lost(set.error().message);
    const auto texture = document_.element("textures", *number);
    if (!texture) return lost(texture.error().message);
    const Result<std::string> picture = pictureOf(**texture);
    if (!picture) return lost(picture.error().message);
    material.textures.push_back({role, *picture, static_cast<std::uint32_t>(*set)});
    use.erase("index");
    use.erase("texCoord");
    // A sampler belongs to the use of the texture here, since the model has none; one with no members says
    // nothing.
    if ((*texture)->contains("sampler")) {
      const auto samplerNumber = GltfDocument::wholeNumber(**texture, "sampler");
      const auto sampler = document_.element("samplers", samplerNumber.value_or(~std::uint64_t{0}));
      if (sampler && !(*sampler)->empty()) use["sampler"] = **sampler;
    }
    if (!use.empty()) material.verbatim["gltf:" + role] = dumped(use);
  }

  Result<std::string> pictureOf(const Json& texture) {
    std::optional<std::uint64_t> image;
    if (texture.contains("source")) {
      ARETE_TRY(const auto source, GltfDocument::wholeNumber(texture, "source"));
      image = source;
    }
    // The picture for programs without an extension counts if there is one, otherwise the first one of an
    // extension. Further ones are counted for a warning.
    for (const char* name : kImageExtensions) {
      const Json* const extension = extensionOf(texture, name);
      const auto source = extension == nullptr
                              ? std::nullopt
                              : std::optional(GltfDocument::wholeNumber(*extension, "source"));
      if (!source || !*source) continue;
      if (image)
        ++furtherPictures;
      else
        image = **source;
    }
    if (!image) return failure(ErrorCode::corrupt, "it names no picture");
    auto known = pictures_.find(*image);
    if (known == pictures_.end()) known = pictures_.emplace(*image, readImage(*image)).first;
    return known->second;
  }

  /// A picture with bytes, in a view or a data URI, becomes one of the model and is named "#" and its number;
  /// a file keeps its name.
  Result<std::string> readImage(std::uint64_t number) {
    ARETE_TRY(const auto image, document_.element("images", number));
    EmbeddedPicture picture{
        .name = textOf(*image, "name"), .mimeType = textOf(*image, "mimeType"), .bytes = {}};
    const std::string uri = textOf(*image, "uri");
    std::string decoded;
    std::string_view bytes;
    if (image->contains("bufferView")) {
      ARETE_TRY(const auto viewNumber, GltfDocument::wholeNumber(*image, "bufferView"));
      ARETE_TRY(const auto view, document_.views().view(document_, viewNumber));
      bytes = view.bytes;
    } else if (GltfBuffers::isDataUri(uri)) {
      Result<std::string> data = GltfBuffers::dataOf(uri);
      if (!data) return failure(data.error().code, "its picture " + data.error().message);
      decoded = std::move(*data);
      bytes = decoded;
      const std::size_t colon = uri.find(':'), end = uri.find_first_of(";,");
      if (picture.mimeType.empty()) picture.mimeType = uri.substr(colon + 1, end - colon - 1);
    } else {
      if (uri.empty()) return failure(ErrorCode::corrupt, "its picture has neither bytes nor a name");
      return percentDecoded(uri);
    }
    ARETE_CHECK(document_.views().reserve(bytes.size()));
    const auto* const first = reinterpret_cast<const std::byte*>(bytes.data());
    picture.bytes.assign(first, first + bytes.size());
    result.pictures.push_back(std::move(picture));
    return fmt::format("#{}", result.pictures.size() - 1);
  }

  const GltfDocument& document_;
  std::map<std::uint64_t, Result<std::string>> pictures_;  // by image
};

}  // namespace

GltfMaterials readMaterials(const GltfDocument& document, Warnings& warnings) {
  constexpr std::size_t kMostProblems = 8;
  MaterialReader reader(document);
  reader.read();
  const auto& problems = reader.problems;
  for (std::size_t i = 0; i < std::min(problems.size(), kMostProblems); ++i)
    warnings.push_back({WarningCode::omitted, problems[i]});
  if (problems.size() > kMostProblems)
    warnings.push_back({WarningCode::omitted,
                        fmt::format("{} more problems of materials", problems.size() - kMostProblems)});
  const auto count = [&](std::uint64_t number, const char* one, const char* many) {
    if (number > 0)
      warnings.push_back(
          {WarningCode::omitted, fmt::format("{} {} left out", number, number == 1 ? one : many)});
  };
  count(reader.unusedImages, "picture that no material uses is", "pictures that no material uses are");
  count(reader.furtherPictures, "picture is another form of one that is read, and",
        "pictures are other forms of those that are read, and");
  return std::move(reader.result);
}

}  // namespace arete
