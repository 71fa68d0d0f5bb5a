// SPDX-License-Identifier: GPL-3.0-or-later
//
// The standard has PNG and JPEG, its extensions WebP and KTX 2. What a picture is, its first bytes say: names
// and media types of files lie.
#include "io/formats/glb/writer/textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "io/files/text_scan.h"

namespace arete {
namespace {

struct Kind {
  std::string_view mimeType;
  const char* extension;  // of the texture; null: the standard has it
};

std::optional<Kind> kindOf(const std::vector<std::byte>& bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("\x89PNG\r\n\x1A\n")) return Kind{"image/png", nullptr};
  if (text.starts_with("\xFF\xD8\xFF")) return Kind{"image/jpeg", nullptr};
  if (text.starts_with("RIFF") && text.substr(std::min<std::size_t>(8, text.size())).starts_with("WEBP"))
    return Kind{"image/webp", "EXT_texture_webp"};
  if (text.starts_with("\xABKTX 20\xBB\r\n\x1A\n")) return Kind{"image/ktx2", "KHR_texture_basisu"};
  return std::nullopt;
}

}  // namespace

std::optional<std::size_t> GltfTextures::pictureNumber(const std::string& picture) {
  const auto [found, isNew] = pictureNumbers_.try_emplace(picture);
  if (!isNew) return found->second;
  Result<PictureBytes> read = source_.read(picture);
  if (!read) {
    lost_.push_back(fmt::format("the picture {}: it {}", text::quotedToken(picture), read.error().message));
    return std::nullopt;
  }
  const auto kind = kindOf(read->bytes);
  if (!kind) {
    lost_.push_back(fmt::format("the picture {}, which is neither PNG, JPEG, WebP nor KTX 2",
                                text::quotedToken(picture.starts_with('#') ? read->name : picture)));
    return std::nullopt;
  }
  found->second = pictures_.size();
  pictures_.push_back({std::move(read->name), std::string(kind->mimeType), std::move(read->bytes)});
  return found->second;
}

std::optional<std::size_t> GltfTextures::texture(const std::string& picture, const Json& sampler) {
  const auto number = pictureNumber(picture);
  if (!number) return std::nullopt;
  Json texture = Json::object();
  if (sampler.is_object()) {
    const auto [found, isNew] = samplerNumbers_.try_emplace(sampler.dump(), samplers_.size());
    if (isNew) samplers_.push_back(sampler);
    texture["sampler"] = found->second;
  }
  if (const char* extension = kindOf(pictures_[*number].bytes)->extension) {
    texture["extensions"][extension]["source"] = *number;
    extensions_.insert(extension);
  } else {
    texture["source"] = *number;
  }
  const auto [found, isNew] = textureNumbers_.try_emplace(texture.dump(), textures_.size());
  if (isNew) textures_.push_back(std::move(texture));
  return found->second;
}

}  // namespace arete
