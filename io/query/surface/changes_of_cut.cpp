// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/surface/changes_of_cut.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "surface/attributes/attribute_names.h"
#include "surface/front/face_map.h"

namespace arete {
namespace {

/// So many take about a hundredth of the time of a cut of 100 000 faces.
constexpr std::uint32_t kMostFaces = 1000;

}  // namespace

std::vector<AttributeChange> changesOfCut(const SurfaceModel& model, const TakenSurface& taken) {
  if (namedAttributes(model.attributes).empty()) return {};
  std::vector<ComparedFace> faces;
  for (const FaceInCut& found : someFacesOf(model, taken.whole, kMostFaces)) {
    std::uint32_t triangle = found.triangle;
    if (!taken.numberOf.empty()) triangle = taken.numberOf[triangle];
    if (triangle == MeshAttributes::kNone) continue;
    const std::array<std::uint32_t, 3> corners = model.mt.corners(TriangleId(found.finest));
    faces.push_back({.vertices = corners,
                     .wedges = model.hasWedges() ? model.wedgesOf[found.finest] : corners,
                     .face = model.faceOf[found.finest],
                     .middle = found.middle,
                     .triangle = triangle});
  }
  return attributeChanges(model.attributes, taken.front.mesh, faces);
}

std::string changesText(const std::vector<AttributeChange>& changes) {
  std::string text;
  for (const AttributeChange& change : changes) {
    if (change.compared == 0) continue;
    text += fmt::format("  {:<10} ", change.name);
    if (change.isEquality)
      text += change.unequal == 0
                  ? fmt::format("the same at {} faces of the source\n", change.compared)
                  : fmt::format("another at {} of {} faces of the source\n", change.unequal, change.compared);
    else if (std::isinf(change.largest))
      text += fmt::format("cannot be compared at {} of {} faces of the source\n", change.unequal,
                          change.compared);
    else
      text += fmt::format("changes by up to {:.4g} {}, at {} faces of the source\n", change.largest,
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

std::string movedText(const std::vector<AttributeRms>& moved) {
  std::string text;
  for (const AttributeRms& of : moved)
    text += fmt::format("  {:<10} RMS {:.4g} at the nearest point; {:.4g} before vertices moved\n",
                        optionNameOf(of.name), of.after, of.before);
  return text;
}

nlohmann::ordered_json toJson(const AttributeRms& of) {
  return {{"name", optionNameOf(of.name)}, {"rmsBefore", of.before}, {"rmsAfter", of.after}};
}

}  // namespace arete
