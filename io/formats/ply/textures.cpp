// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/ply/textures.h"

#include <algorithm>
#include <utility>

#include "io/files/text_scan.h"
#include "io/formats/common/losses.h"
#include "io/formats/common/pictures.h"
#include "io/formats/ply/notes.h"

namespace arete {

namespace {

const TextureUse* pictureOf(const Material& material) {
  for (const char* role : {"baseColor", "map_Kd"})
    for (const TextureUse& use : material.textures)
      if (use.role == role) return &use;
  return nullptr;
}

}  // namespace

Result<PlyTextures> plyTextures(MeshRef mesh, const std::filesystem::path& path,
                                const MeshWriteOptions& options) {
  PlyTextures result;
  std::vector<std::int32_t> numberOf;  // by material
  MeshAttributes poorer;               // materials that have more than comes back
  const PictureSource source(mesh.attributes, options.pictureFolder);
  PicturePlacer placer(source, path);
  for (const Material& material : mesh.attributes.materials) {
    const TextureUse* const use = pictureOf(material);
    std::string picture;
    if (use) {
      ARETE_TRY(std::string placed, placer.place(use->picture));
      picture = text::onOneLine(placed);
    }
    // A picture that was inside the mesh's file and cannot be placed has no name.
    numberOf.push_back(picture.empty() ? -1 : static_cast<std::int32_t>(result.pictures.size()));
    Material back;
    if (!picture.empty()) {
      back = {.name = plyMaterialName(picture)};
      back.textures.push_back({"baseColor", use->picture});
      result.pictures.push_back(std::move(picture));
    }
    if (!(material == back)) poorer.materials.push_back(material);
  }
  const std::vector<std::string> lost = lossesOf(poorer, {.pictures = true});
  for (const std::string& one : lost) result.lost.push_back(one + " but for a picture each");
  result.lost.insert(result.lost.end(), placer.warnings().begin(), placer.warnings().end());
  result.files = placer.files();
  if (result.pictures.empty()) return result;

  for (const std::uint32_t material : mesh.attributes.materialOf)
    result.numbers.push_back(material == MeshAttributes::kNone ? -1 : numberOf[material]);
  result.numbers.resize(mesh.shape.triangles.size(), -1);
  if (std::ranges::all_of(result.numbers, [](std::int32_t number) { return number == 0; }))
    result.numbers.clear();
  return result;
}

}  // namespace arete
