// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/surface/changes_of_cut.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "surface/attributes/attribute_names.h"
#include "surface/front/face_map.h"

namespace arete {

std::vector<AttributeChange> changesOfCut(const SurfaceModel& model, const TakenSurface& taken) {
  if (namedAttributes(model.attributes).empty()) return {};
  const std::vector<std::uint32_t> byFace = facesOf(model, taken.whole);
  const SurfaceFront source = finestSurfaceOf(model);
  std::vector<std::uint32_t> triangleFor;
  triangleFor.reserve(source.faceOf.size());
  for (const std::uint32_t face : source.faceOf) {
    std::uint32_t triangle = byFace[face];
    if (triangle != MeshAttributes::kNone && !taken.numberOf.empty()) triangle = taken.numberOf[triangle];
    triangleFor.push_back(triangle);
  }
  return attributeChanges(source.mesh, taken.front.mesh, triangleFor);
}

std::string changesText(const std::vector<AttributeChange>& changes) {
  std::string text;
  for (const AttributeChange& change : changes) {
    if (change.compared == 0) continue;
    text += fmt::format("  {:<10} ", change.name);
    if (change.isEquality)
      text += change.unequal == 0 ? fmt::format("the same at {} places of the source\n", change.compared)
                                  : fmt::format("another at {} of {} places of the source\n", change.unequal,
                                                change.compared);
    else if (std::isinf(change.largest))
      text += fmt::format("cannot be compared at {} of {} places of the source\n", change.unequal,
                          change.compared);
    else
      text += fmt::format("changes by up to {:.4g} {}, at {} places of the source\n", change.largest,
                          change.unit == "255ths" ? "of 255" : change.unit, change.compared);
  }
  return text;
}

nlohmann::ordered_json toJson(const AttributeChange& change) {
  return {{"name", change.name},
          {"largest",
           std::isfinite(change.largest) ? nlohmann::ordered_json(change.largest) : nlohmann::ordered_json()},
          {"unit", change.unit},
          {"compared", change.compared},
          {"unequal", change.unequal}};
}

}  // namespace arete
