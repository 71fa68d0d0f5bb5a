// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "io/formats/glb/writer/textures.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// The materials of a mesh as those of a glTF, in their order.
struct WrittenMaterials {
  using Json = nlohmann::ordered_json;
  Json materials = Json::array(), textures = Json::array(), samplers = Json::array();
  std::vector<GltfTextures::Picture> pictures = {};
  std::set<std::string> extensions = {};  ///< that they use and a reader may ignore
  std::set<std::string> required = {};    ///< that it may not
  std::vector<std::string> lost = {};     ///< as in MeshWriteReport
};

/// What came from a glTF (Material::verbatim["gltf"], and for a texture "gltf:" and its role) is written
/// again; of an MTL, what has a place (io/formats/glb/writer/mtl_material.h).
///
/// @param folder Where pictures are, as in MeshFile.
/// @param textureSets By set of the mesh, that of the glTF. A texture of another set is left out and named.
WrittenMaterials writtenMaterials(const MeshAttributes& mesh, const std::filesystem::path& folder,
                                  const std::map<std::uint32_t, std::uint32_t>& textureSets);

}  // namespace arete
