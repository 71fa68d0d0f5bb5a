// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each list of a level is appended to the list of the whole, and the numbers that name its elements grow by
// what was there before. Arete's files have their bytes in the first buffer; a packed one has a second
// without bytes, and the whole has at most one of each.
#include "io/formats/glb/levels/join_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "io/files/file_bytes.h"
#include "io/formats/glb/writer/container.h"

namespace arete {
namespace {

using LevelJson = nlohmann::ordered_json;

constexpr const char *kLod = "MSFT_lod", *kCompression = "EXT_meshopt_compression";

struct ReadLevel {
  LevelJson document;
  std::string bytes;  ///< of the first buffer
};

Result<ReadLevel> readLevel(const std::filesystem::path& path) {
  ARETE_TRY(const FileBytes file, FileBytes::read(path));
  const std::string_view all = file.view();
  const auto wordAt = [&](std::size_t at) {
    std::uint32_t word = 0;
    if (at + sizeof word <= all.size()) std::memcpy(&word, all.data() + at, sizeof word);
    return std::size_t{word};
  };
  constexpr std::size_t kHeader = 12, kChunk = 8;
  const std::size_t json = wordAt(kHeader), begin = kHeader + kChunk;
  if (!all.starts_with("glTF") || begin + json > all.size())
    return failure(ErrorCode::corrupt, "is not a GLB", path.string());
  ReadLevel level;
  level.document = LevelJson::parse(all.substr(begin, json), nullptr, false);
  if (level.document.is_discarded() || !level.document.contains("nodes"))
    return failure(ErrorCode::corrupt, "is a level that shows nothing", path.string());
  if (const std::size_t data = begin + json; data + kChunk <= all.size())
    level.bytes = all.substr(data + kChunk, wordAt(data));
  return level;
}

/// The diagonal of the box of a level, whose nodes have one scale and translation.
double diagonalOf(const LevelJson& level) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{kNone, kNone, kNone}, high{-kNone, -kNone, -kNone};
  for (const LevelJson& node : level["nodes"]) {
    if (!node.contains("mesh")) continue;
    for (const LevelJson& primitive : level["meshes"][node["mesh"].get<std::size_t>()]["primitives"]) {
      const LevelJson& places = level["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
      for (std::size_t k = 0; k < 3; ++k) {
        const double scale = node.contains("scale") ? node["scale"][k].get<double>() : 1;
        low[k] = std::min(low[k], scale * places["min"][k].get<double>());
        high[k] = std::max(high[k], scale * places["max"][k].get<double>());
      }
    }
  }
  const double diagonal = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  return std::isfinite(diagonal) ? diagonal : 0;
}

/// @param sizes errors as parts of the diagonal of everything
std::vector<double> coveragesOf(const std::vector<double>& sizes) {
  constexpr double kPixels = 1920.0 * 1080.0;
  std::vector<double> coverages;
  double before = 1;
  for (std::size_t i = 1; i < sizes.size(); ++i) {
    // So long is the diagonal where the error of the next level is a pixel.
    const double pixels = sizes[i] > 0 ? 1 / sizes[i] : std::numeric_limits<double>::infinity();
    before = std::min(before, std::numbers::pi / 4 * pixels * pixels / kPixels);
    coverages.push_back(before);
  }
  coverages.push_back(0);
  return coverages;
}

class Joiner {
 public:
  void add(ReadLevel level, const GltfLevel& about) {
    LevelJson& from = level.document;
    if (document_.is_null()) {
      document_ = {{"asset", from["asset"]}};
      diagonal_ = diagonalOf(from);
    }
    for (const char* const key : {"extensionsUsed", "extensionsRequired"})
      if (from.contains(key))
        for (const LevelJson& name : from[key]) extensions_[key].insert(name.get<std::string>());
    const bool isShared = sharesLooks(from, level.bytes);
    const std::size_t views = lists_["bufferViews"].size(), accessors = lists_["accessors"].size(),
                      meshes = lists_["meshes"].size(), nodes = lists_["nodes"].size();
    std::vector<LevelJson> ofLevel = listOf(from, "bufferViews");
    // The pictures come last in a file of ours.
    if (isShared)
      for (const LevelJson& image : listOf(from, "images"))
        if (image.contains("bufferView"))
          ofLevel.resize(std::min(ofLevel.size(), image["bufferView"].get<std::size_t>()));
    for (LevelJson& view : ofLevel) {
      moveView(view, level.bytes);
      lists_["bufferViews"].push_back(std::move(view));
    }
    if (!isShared) appendLooks(from, views);
    for (LevelJson& accessor : listOf(from, "accessors")) {
      shift(accessor, "bufferView", views);
      lists_["accessors"].push_back(std::move(accessor));
    }
    for (LevelJson& mesh : listOf(from, "meshes")) {
      for (LevelJson& primitive : mesh["primitives"]) {
        shift(primitive, "indices", accessors);
        shift(primitive, "material", isShared ? 0 : materials_);
        for (auto& [name, accessor] : primitive["attributes"].items())
          accessor = accessor.get<std::size_t>() + accessors;
      }
      lists_["meshes"].push_back(std::move(mesh));
    }
    sizes_.push_back(diagonal_ > 0 ? about.error * about.unit / diagonal_ : 0);
    LevelJson children = LevelJson::array();
    for (LevelJson& node : from["nodes"]) {
      shift(node, "mesh", meshes);
      children.push_back(nodes + children.size());
      lists_["nodes"].push_back(std::move(node));
    }
    levels_.push_back(lists_["nodes"].size());
    lists_["nodes"].push_back(
        {{"name", "level " + std::to_string(levels_.size() - 1)},
         {"children", std::move(children)},
         {"extras", {{"arete", {{"error", about.error}, {"triangles", about.triangles}}}}}});
    materials_ = lists_["materials"].size();
  }

  GltfContent content() {
    if (levels_.size() > 1) {
      lists_["nodes"][levels_.front()]["extensions"] = {
          {kLod, {{"ids", std::vector<std::size_t>(levels_.begin() + 1, levels_.end())}}}};
      lists_["nodes"][levels_.front()]["extras"]["MSFT_screencoverage"] = coveragesOf(sizes_);
      extensions_["extensionsUsed"].insert(kLod);
    }
    GltfContent content;
    for (const char* const key : {"extensionsUsed", "extensionsRequired"})
      if (!extensions_[key].empty()) document_[key] = extensions_[key];
    document_["scene"] = 0;
    document_["scenes"] = {{{"nodes", {levels_.front()}}}};
    for (const char* const key :
         {"nodes", "materials", "textures", "images", "samplers", "meshes", "accessors", "bufferViews"})
      if (!lists_[key].empty()) document_[key] = std::move(lists_[key]);
    document_["buffers"] = LevelJson::array({{{"byteLength", bytes_.size()}}});
    if (decodedSize_ > 0)
      document_["buffers"].push_back(
          {{"byteLength", decodedSize_}, {"extensions", {{kCompression, {{"fallback", true}}}}}});
    content.document = std::move(document_);
    content.bufferSize = bytes_.size();
    content.writeBuffer = [bytes = std::make_shared<const std::string>(std::move(bytes_))](ByteSink& sink) {
      sink.write(*bytes);
      return sink.goesOn();
    };
    return content;
  }

 private:
  static LevelJson listOf(const LevelJson& from, const char* key) {
    return from.contains(key) ? from[key] : LevelJson::array();
  }
  static void shift(LevelJson& object, const char* key, std::size_t by) {
    if (object.contains(key)) object[key] = object[key].get<std::size_t>() + by;
  }
  std::size_t append(std::string_view bytes) {
    const std::size_t at = bytes_.size();
    bytes_ += bytes;
    bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
    return at;
  }

  /// Bytes of one kind are written once, so that pictures are not repeated.
  std::size_t placeOf(std::string_view bytes) {
    const auto [found, isNew] = placeOf_.try_emplace(std::string(bytes), bytes_.size());
    return isNew ? append(bytes) : found->second;
  }

  void moveView(LevelJson& view, const std::string& bytes) {
    LevelJson* in = &view;
    if (view.contains("extensions") && view["extensions"].contains(kCompression)) {
      view["byteOffset"] = decodedSize_;
      decodedSize_ += (view["byteLength"].get<std::uint64_t>() + 3) / 4 * 4;
      in = &view["extensions"][kCompression];
    }
    const std::size_t offset = (*in)["byteOffset"].get<std::size_t>();
    const std::string_view part =
        std::string_view(bytes).substr(offset, (*in)["byteLength"].get<std::size_t>());
    (*in)["byteOffset"] = placeOf(part);
  }

  /// The materials with all that they need; equal for levels that can share them.
  static LevelJson looksOf(const LevelJson& from, const std::string& bytes) {
    LevelJson looks = LevelJson::array();
    for (const char* const key : {"materials", "textures", "images", "samplers"})
      looks.push_back(listOf(from, key));
    for (LevelJson& image : looks[2]) {
      if (!image.contains("bufferView")) continue;
      const LevelJson& view = from["bufferViews"][image["bufferView"].get<std::size_t>()];
      image["bufferView"] = std::hash<std::string_view>()(std::string_view(bytes).substr(
          view["byteOffset"].get<std::size_t>(), view["byteLength"].get<std::size_t>()));
    }
    return looks;
  }

  /// False if the looks of a level are to be appended.
  bool sharesLooks(const LevelJson& from, const std::string& bytes) {
    LevelJson looks = looksOf(from, bytes);
    if (!levels_.empty()) return looks == looks_;
    looks_ = std::move(looks);
    return false;
  }

  void appendLooks(LevelJson& from, std::size_t views) {
    const std::size_t textures = lists_["textures"].size(), images = lists_["images"].size(),
                      samplers = lists_["samplers"].size();
    for (LevelJson& image : listOf(from, "images")) {
      shift(image, "bufferView", views);
      lists_["images"].push_back(std::move(image));
    }
    for (LevelJson& texture : listOf(from, "textures")) {
      shift(texture, "source", images);
      shift(texture, "sampler", samplers);
      if (texture.contains("extensions"))
        for (auto& [name, extension] : texture["extensions"].items()) shift(extension, "source", images);
      lists_["textures"].push_back(std::move(texture));
    }
    for (LevelJson& sampler : listOf(from, "samplers")) lists_["samplers"].push_back(std::move(sampler));
    for (LevelJson& material : listOf(from, "materials")) {
      shiftTextures(material, textures);
      lists_["materials"].push_back(std::move(material));
    }
  }

  /// A texture is named by an object whose name ends in "Texture".
  static void shiftTextures(LevelJson& object, std::size_t by) {
    if (!object.is_object()) return;
    for (auto& [name, member] : object.items()) {
      if (name.ends_with("Texture") && member.is_object()) shift(member, "index", by);
      if (name != "extras") shiftTextures(member, by);
    }
  }

  LevelJson document_, looks_;
  std::map<std::string, LevelJson> lists_;
  std::map<std::string, std::set<std::string>> extensions_;
  std::map<std::string, std::size_t> placeOf_;
  std::vector<std::size_t> levels_;  // their nodes
  std::vector<double> sizes_;        // of their errors, as parts of the diagonal
  double diagonal_ = 0;              // of the finest
  std::size_t materials_ = 0;
  std::string bytes_;
  std::uint64_t decodedSize_ = 0;
};

}  // namespace

Status joinGltfLevels(std::vector<GltfLevel> levels, const std::filesystem::path& path, bool asText,
                      const RunContext& context) {
  std::ranges::stable_sort(levels, std::ranges::greater{}, &GltfLevel::triangles);
  Joiner joiner;
  for (const GltfLevel& about : levels) {
    ARETE_TRY(ReadLevel level, readLevel(about.file));
    joiner.add(std::move(level), about);
  }
  return writeContainer(joiner.content(), path, asText, context);
}

}  // namespace arete
