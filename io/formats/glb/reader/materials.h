// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/warning.h"
#include "io/formats/glb/document.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// The materials of a glTF, and the pictures in it that they use.
///
/// A texture's role is baseColor, metallicRoughness, normal, occlusion or emissive; that of an extension is
/// its path in the material: "extensions/KHR_materials_sheen/sheenColorTexture". Material::verbatim has under
/// "gltf" the JSON of the material without what has a field and without its textures; under "gltf:ROLE" that
/// of the texture's use (scale, strength, extensions) without index and texCoord, with the "sampler" of the
/// texture in it. Both are left out if they are empty.
struct GltfMaterials {
  std::vector<Material> materials;
  std::vector<EmbeddedPicture> pictures;
};

/// Never fails: what is damaged is left out with a warning.
GltfMaterials readMaterials(const GltfDocument& document, Warnings& warnings);

}  // namespace arete
