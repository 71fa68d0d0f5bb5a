// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "io/formats/glb/writer/framed.h"
#include "io/formats/glb/writer/materials.h"
#include "io/formats/glb/writer/mesh_plan.h"
#include "io/formats/glb/writer/textures.h"
#include "io/formats/glb/writer/vertex_values.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// All that a glTF of a surface is made of.
struct GltfParts {
  SurfaceMesh mesh;  ///< without wedges; its vertex attributes have moved to `values`
  std::vector<Float3> positions = {};
  Vec3 translation = {};  ///< of every node
  GltfVertexValues values = {};
  WrittenMaterials materials = {};
  MeshPlan plan = {};
  nlohmann::ordered_json asset = {};
};

/// The lists of a document that depend on how its numbers are stored.
struct GltfLists {
  using Json = nlohmann::ordered_json;
  Json nodes = Json::array(), meshes = Json::array(), images = Json::array(), accessors = Json::array(),
       views = Json::array(), buffers = Json::array();
  std::set<std::string> required = {};  ///< extensions

  void addObject(const ObjectPlan& object, Json primitives);
  /// @param view The number of the view of its bytes.
  void addImage(const GltfTextures::Picture& picture, std::size_t view);
};

/// The document: one scene, of which every node is a root. O(size).
nlohmann::ordered_json assembledDocument(const GltfParts& parts, GltfLists lists);

/// Bytes until the next multiple of four.
std::size_t paddedToFour(std::size_t bytes);
/// The code of the standard for the numbers of a type.
int gltfComponentOf(ScalarType type);
/// "VEC3" of three components.
const char* gltfTypeOf(std::size_t components);

}  // namespace arete
