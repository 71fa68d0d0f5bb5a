// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/attributes/picture_sizes.h"

#include <map>
#include <string>

#include "io/formats/common/picture_pixels.h"
#include "io/formats/common/pictures.h"

namespace arete {
namespace {

bool isOfColors(const TextureUse& use) {
  return use.role == "baseColor" || use.role == "map_Kd";
}

}  // namespace

Result<std::vector<std::array<double, 2>>> pictureSizesOf(const MeshAttributes& mesh,
                                                          const std::filesystem::path& folder,
                                                          std::uint32_t textureCoords) {
  const PictureSource source(mesh, folder);
  std::map<std::string, std::array<double, 2>> known;
  std::vector<std::array<double, 2>> sizes;
  for (const Material& material : mesh.materials) {
    const TextureUse* chosen = nullptr;
    for (const TextureUse& use : material.textures)
      if (use.textureCoords == textureCoords && (!chosen || (isOfColors(use) && !isOfColors(*chosen))))
        chosen = &use;
    if (!chosen) {
      sizes.push_back({0, 0});
      continue;
    }
    auto at = known.find(chosen->picture);
    if (at == known.end()) {
      ARETE_TRY(const PictureBytes bytes, source.read(chosen->picture));
      const Result<std::array<std::uint32_t, 2>> size = pictureSize(bytes.bytes);
      if (!size) return failure(size.error().code, size.error().message, bytes.name);
      at =
          known.emplace(chosen->picture, std::array<double, 2>{double((*size)[0]), double((*size)[1])}).first;
    }
    sizes.push_back(at->second);
  }
  return sizes;
}

}  // namespace arete
