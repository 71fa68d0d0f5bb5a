// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/glb/writer/parts.h"

#include <utility>

#include "io/formats/glb/writer/buffer_plan.h"

namespace arete {

using PartsJson = nlohmann::ordered_json;

std::size_t paddedToFour(std::size_t bytes) {
  return (bytes + 3) / 4 * 4;
}

int gltfComponentOf(ScalarType type) {
  switch (type) {
    case ScalarType::int8:
      return GltfCode::kByte;
    case ScalarType::uint8:
      return GltfCode::kUnsignedByte;
    case ScalarType::int16:
      return GltfCode::kShort;
    case ScalarType::uint16:
      return GltfCode::kUnsignedShort;
    default:
      return GltfCode::kFloat;
  }
}

const char* gltfTypeOf(std::size_t components) {
  switch (components) {
    case 1:
      return "SCALAR";
    case 2:
      return "VEC2";
    case 3:
      return "VEC3";
    case 4:
      return "VEC4";
    case 9:
      return "MAT3";
    default:
      return "MAT4";
  }
}

void GltfLists::addObject(const ObjectPlan& object, Json primitives) {
  Json node = Json::object(), mesh = Json::object();
  if (!object.name.empty()) node["name"] = mesh["name"] = object.name;
  node["mesh"] = meshes.size();
  mesh["primitives"] = std::move(primitives);
  nodes.push_back(std::move(node));
  meshes.push_back(std::move(mesh));
}

void GltfLists::addImage(const GltfTextures::Picture& picture, std::size_t view) {
  images.push_back({{"mimeType", picture.mimeType}, {"bufferView", view}});
  if (!picture.name.empty()) images.back()["name"] = picture.name;
}

PartsJson assembledDocument(const GltfParts& parts, GltfLists lists) {
  PartsJson document = {{"asset", parts.asset}};
  // The standard does not allow an empty list, so lists without elements are left out.
  const auto add = [&](const char* key, PartsJson list) {
    if (!list.empty()) document[key] = std::move(list);
  };
  std::set<std::string> used = parts.materials.extensions, required = parts.materials.required;
  required.insert(lists.required.begin(), lists.required.end());
  used.insert(required.begin(), required.end());
  add("extensionsUsed", used);
  add("extensionsRequired", required);
  PartsJson roots = PartsJson::array();
  for (std::size_t n = 0; n < lists.nodes.size(); ++n) roots.push_back(n);
  document["scene"] = 0;
  document["scenes"] = {{{"nodes", std::move(roots)}}};
  document["nodes"] = std::move(lists.nodes);
  add("materials", parts.materials.materials);
  add("textures", parts.materials.textures);
  add("images", std::move(lists.images));
  add("samplers", parts.materials.samplers);
  document["meshes"] = std::move(lists.meshes);
  document["accessors"] = std::move(lists.accessors);
  document["bufferViews"] = std::move(lists.views);
  document["buffers"] = std::move(lists.buffers);
  return document;
}

}  // namespace arete
