// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/formats/common/pictures.h"

namespace arete {

/// The textures, pictures and samplers of a glTF. Pictures are read when they are first used.
class GltfTextures {
 public:
  using Json = nlohmann::ordered_json;

  struct Picture {
    std::string name, mimeType;
    std::vector<std::byte> bytes;
  };

  /// @param mesh must outlive this.
  GltfTextures(const MeshAttributes& mesh, const std::filesystem::path& folder) : source_(mesh, folder) {}

  /// The texture of a picture and a sampler (null: none); the same pair is one texture.
  /// @return Nothing if glTF cannot have the picture: then it is in lost().
  std::optional<std::size_t> texture(const std::string& picture, const Json& sampler);

  std::vector<Picture> takePictures() { return std::move(pictures_); }
  const Json& textures() const { return textures_; }
  const Json& samplers() const { return samplers_; }
  /// Extensions that a reader needs for the pictures.
  const std::set<std::string>& extensions() const { return extensions_; }
  const std::vector<std::string>& lost() const { return lost_; }

 private:
  std::optional<std::size_t> pictureNumber(const std::string& picture);

  PictureSource source_;
  std::vector<Picture> pictures_;
  std::map<std::string, std::optional<std::size_t>> pictureNumbers_;
  std::map<std::string, std::size_t> textureNumbers_, samplerNumbers_;  // by what is in them
  Json textures_ = Json::array(), samplers_ = Json::array();
  std::set<std::string> extensions_;
  std::vector<std::string> lost_;
};

}  // namespace arete
