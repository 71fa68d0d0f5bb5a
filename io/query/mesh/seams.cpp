// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/mesh/seams.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "io/files/text/grouped.h"
#include "surface/edit/drop_attributes.h"
#include "surface/edit/normals.h"
#include "surface/model/labels.h"

namespace arete {
namespace {

bool areSeveral(const std::vector<std::uint32_t>& parts) {
  return std::ranges::any_of(parts, [&](std::uint32_t part) { return part != parts.front(); });
}

bool hasSeveralValues(const Attribute& attribute) {
  const std::size_t size = attribute.elementBytes();
  for (std::size_t i = size; i + size <= attribute.values.size(); i += size)
    if (std::memcmp(&attribute.values[i], attribute.values.data(), size) != 0) return true;
  return false;
}

}  // namespace

std::string seamsText(const SurfaceMesh& mesh) {
  std::vector<std::string> sentences, names;
  for (const SeamAttribute& seam : seamAttributes(mesh)) {
    sentences.push_back(fmt::format("\"{}\" differs at {}", seam.name, grouped(seam.edges, "edge", "edges")));
    names.push_back(seam.name);
  }
  for (const Attribute& attribute : mesh.triangleAttributes)
    if (isLabel(attribute) && hasSeveralValues(attribute)) {
      sentences.push_back(fmt::format("\"{}\" differs from face to face", attribute.name));
      names.push_back(attribute.name);
    }
  for (const auto& [of, name] :
       {std::pair{&mesh.objectOf, kObjectsName}, std::pair{&mesh.materialOf, kMaterialsName}})
    if (areSeveral(*of)) {
      sentences.push_back(fmt::format("there are several {}", name));
      names.emplace_back(name);
    }
  if (names.empty()) return {};
  return fmt::format("; {}: `dropAttributes` {} leaves {} out", fmt::join(sentences, ", "),
                     fmt::join(names, ","), names.size() == 1 ? "it" : "them");
}

}  // namespace arete
