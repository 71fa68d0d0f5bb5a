// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/attributes/attribute_parts.h"

#include <set>
#include <utility>

#include "measure/near_numbers.h"

namespace arete {

std::vector<std::uint32_t> NumbersForNames::of(const SurfaceMesh& mesh, NamedAttribute::Of kind) {
  const bool isMaterial = kind == NamedAttribute::Of::materials,
             isObject = kind == NamedAttribute::Of::objects;
  const std::vector<std::uint32_t>& numberOf = isMaterial ? mesh.materialOf
                                               : isObject ? mesh.objectOf
                                                          : mesh.groupOf;
  const auto nameOf = [&](std::uint32_t i) -> const std::string& {
    return isMaterial ? mesh.materials[i].name : isObject ? mesh.objects[i] : mesh.groups[i];
  };
  std::vector<std::uint32_t> numbers;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t i = numberOf.empty() ? MeshAttributes::kNone : numberOf[t];
    if (i == MeshAttributes::kNone)
      numbers.push_back(0);
    else
      numbers.push_back(
          numbers_.emplace(nameOf(i), static_cast<std::uint32_t>(numbers_.size() + 1)).first->second);
  }
  return numbers;
}

AttributeParts partsByName(const SurfaceMesh& source, const SurfaceMesh& other) {
  NumbersForNames materials, objects;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> numbers;
  const auto partsOf = [&](const SurfaceMesh& mesh) {
    const auto material = materials.of(mesh, NamedAttribute::Of::materials);
    const auto object = objects.of(mesh, NamedAttribute::Of::objects);
    std::vector<std::uint32_t> parts;
    for (std::size_t t = 0; t < material.size(); ++t)
      parts.push_back(
          numbers.emplace(std::pair(material[t], object[t]), static_cast<std::uint32_t>(numbers.size()))
              .first->second);
    return parts;
  };
  AttributeParts parts{partsOf(source), partsOf(other)};
  const std::set<std::uint32_t> there(parts.ofOther.begin(), parts.ofOther.end());
  for (std::uint32_t& part : parts.ofSource)
    if (!there.contains(part)) part = ComparedNumbers::kNoPart;
  return parts;
}

}  // namespace arete
