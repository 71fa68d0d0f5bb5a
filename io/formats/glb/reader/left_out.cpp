// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/glb/reader/left_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/files/text_scan.h"
#include "io/formats/glb/extensions.h"

namespace arete {

namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostReasons = 8;

std::uint64_t lengthOf(const Json& object, const char* list) {
  const auto found = object.find(list);
  return found != object.end() && found->is_array() ? found->size() : 0;
}

std::vector<std::string> namesOf(const Json& object, const char* list) {
  std::vector<std::string> names;
  if (lengthOf(object, list) == 0) return names;
  for (const Json& element : object[list])
    if (element.is_object())
      if (const auto name = element.find("name"); name != element.end() && name->is_string())
        names.push_back(*name);
  return names;
}

/// "3 animations (\"run\", \"jump\") are left out".
std::string counted(std::uint64_t count, const char* one, const char* many,
                    const std::vector<std::string>& names = {}) {
  return fmt::format("{} {}{} left out", count, count == 1 ? one : many,
                     (names.empty() ? "" : " (" + listOfNames(names) + ")") + (count == 1 ? " is" : " are"));
}

/// How many morph targets the meshes have, and their names, which exporters put into extras.
std::pair<std::uint64_t, std::vector<std::string>> morphTargets(const Json& document) {
  std::uint64_t count = 0;
  std::vector<std::string> names;
  if (lengthOf(document, "meshes") == 0) return {count, names};
  for (const Json& mesh : document["meshes"]) {
    if (!mesh.is_object() || lengthOf(mesh, "primitives") == 0) continue;
    std::uint64_t most = 0;
    for (const Json& primitive : mesh["primitives"])
      if (primitive.is_object()) most = std::max(most, lengthOf(primitive, "targets"));
    count += most;
    const auto extras = mesh.find("extras");
    if (most == 0 || extras == mesh.end() || !extras->is_object() || lengthOf(*extras, "targetNames") == 0)
      continue;
    for (const Json& name : (*extras)["targetNames"])
      if (name.is_string()) names.push_back(name);
  }
  return {count, names};
}

}  // namespace

std::string listOfNames(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 6;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i)
    list += (i == 0 ? "" : ", ") + text::quotedToken(names[i]);
  if (names.size() > kMost) list += fmt::format(" and {} more", names.size() - kMost);
  return list;
}

std::vector<std::string> GltfLeftOut::sentences(const Json& document) const {
  std::vector<std::string> all;
  const auto add = [&](std::uint64_t count, const char* one, const char* many,
                       const std::vector<std::string>& names = {}) {
    if (count > 0) all.push_back(counted(count, one, many, names));
  };
  add(pointsAndLines, "primitive of points or lines", "primitives of points or lines");
  add(withoutPositions, "primitive without positions", "primitives without positions");
  // A skin explains joints and weights, so these are named only without one.
  if (skinnedNodes == 1)
    all.emplace_back("the skin of 1 node is left out: its mesh stands where the node places it");
  else if (skinnedNodes > 1)
    all.push_back(fmt::format(
        "the skins of {} nodes are left out: their meshes stand where the nodes place them", skinnedNodes));
  else if (jointsWithoutSkin)
    all.emplace_back("the joints and weights of vertices without a skin are left out");
  add(lengthOf(document, "animations"), "animation", "animations", namesOf(document, "animations"));
  const auto [targets, targetNames] = morphTargets(document);
  if (targets > 0)
    all.push_back(counted(targets, "morph target", "morph targets", targetNames) +
                  (appliedMorphs ? "; those with a weight have moved the vertices" : ""));
  add(lengthOf(document, "cameras"), "camera", "cameras", namesOf(document, "cameras"));
  if (const Json* lights = extensionOf(document, "KHR_lights_punctual"))
    add(lengthOf(*lights, "lights"), "light", "lights", namesOf(*lights, "lights"));
  if (const Json* variants = extensionOf(document, "KHR_materials_variants"))
    add(lengthOf(*variants, "variants"), "variant of materials", "variants of materials",
        namesOf(*variants, "variants"));
  if (const std::uint64_t scenes = lengthOf(document, "scenes"); scenes > 1)
    add(scenes - 1, "further scene", "further scenes");
  if (const std::uint64_t meshes = lengthOf(document, "meshes"); meshes > shownMeshes)
    add(meshes - shownMeshes, "mesh that the scene does not show", "meshes that the scene does not show");
  if (farRotations > 0)
    all.push_back(fmt::format("{} {} not of length 1, as the standard has it, and {} divided by {} length",
                              farRotations, farRotations == 1 ? "rotation is" : "rotations are",
                              farRotations == 1 ? "is" : "are", farRotations == 1 ? "its" : "their"));
  add(instanceAttributes, "attribute of instances", "attributes of instances");
  add(unknownMaterials, "material that is named and does not exist",
      "materials that are named and do not exist");
  std::size_t named = 0;
  for (const auto& [name, reason] : attributes)
    if (++named <= kMostReasons)
      all.push_back(fmt::format("the attribute {} is left out: {}", text::quotedToken(name), reason));
  if (named > kMostReasons)
    all.push_back(fmt::format("{} left out", named - kMostReasons == 1 ? std::string("1 more attribute is")
                                                                       : fmt::format("{} more attributes are",
                                                                                     named - kMostReasons)));
  const std::vector<std::string> extensions = extensionsLeftOut(document);
  add(extensions.size(), "extension", "extensions", extensions);
  return all;
}

}  // namespace arete
