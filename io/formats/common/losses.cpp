// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/common/losses.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/files/text_scan.h"

namespace arete {
namespace {

constexpr std::size_t kMostNamesListed = 8;

/// "name" or "name" and 3 more.
std::string listOf(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNamesListed); ++i)
    list += fmt::format("{}{}", i == 0 ? "" : ", ", text::quotedToken(names[i]));
  if (names.size() > kMostNamesListed) list += fmt::format(" and {} more", names.size() - kMostNamesListed);
  return list;
}

void addAttributes(std::vector<std::string>& lost, const std::vector<Attribute>& attributes,
                   const MeshHolds::Test& isHeld, const char* elements) {
  std::vector<std::string> names;
  for (const Attribute& attribute : attributes)
    if (!isHeld || !isHeld(attribute)) names.push_back(attribute.name);
  if (!names.empty()) lost.push_back(fmt::format("{} of {}", listOf(names), elements));
}

}  // namespace

std::vector<std::string> lossesOf(const MeshAttributes& mesh, const MeshHolds& holds) {
  std::vector<std::string> lost;
  addAttributes(lost, mesh.vertexAttributes, holds.vertexAttribute, "vertices");
  addAttributes(lost, mesh.wedgeAttributes, holds.wedgeAttribute, "corners");
  addAttributes(lost, mesh.triangleAttributes, holds.triangleAttribute, "faces");
  if (!holds.objects && !mesh.objects.empty())
    lost.push_back(fmt::format("objects ({})", listOf(mesh.objects)));
  if (!holds.groups && !mesh.groups.empty()) lost.push_back(fmt::format("groups ({})", listOf(mesh.groups)));
  if (!holds.materials && !mesh.materials.empty()) {
    std::vector<std::string> names;
    for (const Material& material : mesh.materials) names.push_back(material.name);
    lost.push_back(fmt::format("materials ({})", listOf(names)));
  }
  if (!holds.pictures &&
      std::ranges::any_of(mesh.materials, [](const Material& m) { return !m.textures.empty(); }))
    lost.push_back("pictures of materials");
  return lost;
}

}  // namespace arete
