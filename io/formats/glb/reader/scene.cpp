// SPDX-License-Identifier: GPL-3.0-or-later
//
// The nodes are visited with their transforms, from the roots, without recursion. The format allows a node
// one parent, so a second visit is an error.
//
// The standard has a mesh with a skin stand where its joints put it. Without the skin it stands where its
// node puts it, as in other programs that do not read skins; most exporters make the two agree in the pose of
// rest.
#include "io/formats/glb/reader/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "io/formats/glb/extensions.h"

namespace arete {

namespace {

using Json = nlohmann::json;

struct Visit {
  std::uint64_t node;
  Affine parent;
};

class Walk {
 public:
  Walk(const GltfDocument& document, std::uint64_t most, GltfLeftOut& leftOut)
      : document_(document), most_(most), leftOut_(leftOut) {}

  Status run() {
    const auto nodes = document_.json().find("nodes");
    if (nodes == document_.json().end() || !nodes->is_array()) return {};
    std::vector<Visit> open;
    ARETE_CHECK(addRoots(open, nodes->size()));
    std::vector<char> visited(nodes->size(), 0);
    while (!open.empty()) {
      const Visit visit = open.back();
      open.pop_back();
      ARETE_TRY(const auto node, document_.element("nodes", visit.node));
      if (std::exchange(visited[visit.node], char{1}) != 0)
        return failure(ErrorCode::corrupt, fmt::format("node {} has two parents", visit.node));
      const Result<Affine> own = nodeTransform(*node, leftOut_.farRotations);
      if (!own) return failure(own.error().code, fmt::format("node {}: {}", visit.node, own.error().message));
      const Affine placed = own->isIdentity() ? visit.parent : visit.parent.after(*own);
      if (node->contains("mesh")) ARETE_CHECK(addMesh(visit.node, *node, placed));
      ARETE_CHECK(addNumbers(*node, "children", placed, open));
    }
    return {};
  }

  std::vector<GltfPlacement> found;

 private:
  /// The nodes of the default scene; without a scene, the nodes without a parent.
  Status addRoots(std::vector<Visit>& open, std::size_t nodes) const {
    const Json& json = document_.json();
    if (json.contains("scenes")) {
      ARETE_TRY(const auto number, GltfDocument::wholeNumber(json, "scene", 0));
      ARETE_TRY(const auto scene, document_.element("scenes", number));
      return addNumbers(*scene, "nodes", {}, open);
    }
    std::vector<Visit> children;
    for (const Json& node : json["nodes"])
      if (node.is_object()) ARETE_CHECK(addNumbers(node, "children", {}, children));
    std::vector<char> isChild(nodes, 0);
    for (const Visit& child : children)
      if (child.node < nodes) isChild[child.node] = 1;
    for (std::size_t n = nodes; n-- > 0;)
      if (!isChild[n]) open.push_back({n, {}});
    return {};
  }

  static Status addNumbers(const Json& object, const char* key, const Affine& parent,
                           std::vector<Visit>& to) {
    const auto list = object.find(key);
    if (list == object.end()) return {};
    if (!list->is_array()) return failure(ErrorCode::corrupt, fmt::format("\"{}\" is not a list", key));
    // Pushed in reverse: the last one pushed is visited first.
    for (std::size_t i = list->size(); i-- > 0;) {
      if (!(*list)[i].is_number_unsigned())
        return failure(ErrorCode::corrupt,
                       fmt::format("\"{}\" holds a value that is not the index of a node", key));
      to.push_back({(*list)[i].get<std::uint64_t>(), parent});
    }
    return {};
  }

  // A node with instances stands for its mesh several times, moved by each instance and then by the node.
  Status addMesh(std::uint64_t number, const Json& node, const Affine& placed) {
    ARETE_TRY(const auto mesh, GltfDocument::wholeNumber(node, "mesh"));
    if (node.contains("skin")) ++leftOut_.skinnedNodes;
    const Json* const instancing = extensionOf(node, "EXT_mesh_gpu_instancing");
    if (instancing == nullptr) return add({number, mesh, placed});
    const auto attributes = instancing->find("attributes");
    if (attributes == instancing->end() || !attributes->is_object())
      return failure(ErrorCode::corrupt, fmt::format("node {} has instances without attributes", number));
    Status ok = addInstances(number, mesh, *attributes, placed);
    if (!ok) ok.error().message = fmt::format("node {}: {}", number, ok.error().message);
    return ok;
  }

  /// The number of placements is bounded, since a small file can repeat a large mesh any number of times.
  Status add(const GltfPlacement& placement) {
    if (found.size() >= most_)
      return failure(ErrorCode::unsupported,
                     "a mesh is repeated so often that it is far larger than the file");
    found.push_back(placement);
    return {};
  }

  /// All attributes of instances must have one count. One that is not known is checked for its count alone.
  Status addInstances(std::uint64_t node, std::uint64_t mesh, const Json& attributes, const Affine& placed) {
    std::optional<GltfElements> translations, rotations, scales;
    std::optional<std::uint64_t> count;
    for (const auto& [name, value] : attributes.items()) {
      const bool isRotation = name == "ROTATION";
      auto* const to = name == "TRANSLATION" ? &translations
                       : isRotation          ? &rotations
                       : name == "SCALE"     ? &scales
                                             : nullptr;
      if (to == nullptr) ++leftOut_.instanceAttributes;
      ARETE_TRY(const auto number, GltfDocument::wholeNumber(attributes, name.c_str()));
      ARETE_TRY(const auto elements, document_.accessor(number, to == nullptr ? ""
                                                                : isRotation  ? "VEC4"
                                                                              : "VEC3"));
      if (count.value_or(elements.count) != elements.count)
        return failure(ErrorCode::corrupt, "has instances of several counts");
      count = elements.count;
      if (to != nullptr) *to = elements;
    }
    // An attribute that is missing has its neutral value: no translation, no rotation, a scale of 1.
    for (std::uint64_t i = 0; i < count.value_or(0); ++i) {
      const auto at = [&](const std::optional<GltfElements>& elements, std::size_t c, double otherwise) {
        return elements ? elements->value(i, c) : otherwise;
      };
      const Result<UnitRotation> rotation =
          unitRotation({at(rotations, 0, 0), at(rotations, 1, 0), at(rotations, 2, 0), at(rotations, 3, 1)});
      if (!rotation)
        return failure(rotation.error().code, fmt::format("instance {} has {}", i, rotation.error().message));
      leftOut_.farRotations += rotation->isFar ? 1 : 0;
      const Affine own =
          affineOf({at(translations, 0, 0), at(translations, 1, 0), at(translations, 2, 0)},
                   rotation->quaternion, {at(scales, 0, 1), at(scales, 1, 1), at(scales, 2, 1)});
      ARETE_CHECK(add({node, mesh, placed.after(own)}));
    }
    return {};
  }

  const GltfDocument& document_;
  std::uint64_t most_;
  GltfLeftOut& leftOut_;
};

}  // namespace

Result<std::vector<GltfPlacement>> placedMeshes(const GltfDocument& document, std::uint64_t most,
                                                GltfLeftOut& leftOut) {
  Walk walk(document, most, leftOut);
  ARETE_CHECK(walk.run());
  return std::move(walk.found);
}

}  // namespace arete
