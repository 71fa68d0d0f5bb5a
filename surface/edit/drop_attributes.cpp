// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/edit/drop_attributes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/base/caught_failure.h"
#include "surface/attributes/attribute_names.h"
#include "surface/model/wedges.h"

namespace arete {

std::vector<std::string> droppableNames(const MeshAttributes& mesh) {
  std::vector<std::string> names;
  for (const auto* const attributes :
       {&mesh.vertexAttributes, &mesh.wedgeAttributes, &mesh.triangleAttributes})
    for (const Attribute& attribute : *attributes)
      if (std::ranges::find(names, attribute.name) == names.end()) names.push_back(attribute.name);
  if (!mesh.objects.empty()) names.emplace_back(kObjectsName);
  if (!mesh.groups.empty()) names.emplace_back(kGroupsName);
  if (!mesh.materials.empty()) names.emplace_back(kMaterialsName);
  return names;
}

Status dropAttributes(SurfaceMesh& mesh, std::span<const std::string> names) try {
  const std::vector<std::string> known = droppableNames(mesh);
  const auto isOne = [](std::string_view inFile, const std::string& name) {
    return inFile == name || optionNameOf(inFile) == name;
  };
  for (const std::string& name : names)
    if (std::ranges::none_of(known, [&](const std::string& one) { return isOne(one, name); }))
      return failure(ErrorCode::usage,
                     known.empty()
                         ? std::string("is no attribute: the mesh has none")
                         : fmt::format("is no attribute of the mesh, which has {}", fmt::join(known, ", ")),
                     name);
  const auto isNamed = [&](std::string_view inFile) {
    return std::ranges::any_of(names, [&](const std::string& name) { return isOne(inFile, name); });
  };
  const auto isDropped = [&](const Attribute& attribute) { return isNamed(attribute.name); };
  std::erase_if(mesh.vertexAttributes, isDropped);
  std::erase_if(mesh.triangleAttributes, isDropped);
  if (std::erase_if(mesh.wedgeAttributes, isDropped) > 0) moveToVertices(mesh);
  if (isNamed(kObjectsName)) {
    mesh.objects.clear();
    mesh.objectOf.clear();
  }
  if (isNamed(kGroupsName)) {
    mesh.groups.clear();
    mesh.groupOf.clear();
  }
  if (isNamed(kMaterialsName)) {
    mesh.materials.clear();
    mesh.materialOf.clear();
    mesh.pictures.clear();
  }
  return {};
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
