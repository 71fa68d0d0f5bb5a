// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/model/surface_model.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/counted.h"
#include "surface/model/parts.h"

namespace arete {
namespace {

Status refuse(const std::string& what) {
  return failure(ErrorCode::invalidData, what);
}

/// A wrong one would take the place of a right one where faces are asked for.
Status checkLeftOutFaces(const SurfaceModel& model) {
  if (model.leftOutFaces.empty()) return {};
  std::vector<std::uint32_t> finest;
  for (std::uint32_t t = 0; t < model.mt.triangleIdCount(); ++t)
    if (!model.mt.remover(TriangleId(t)).isValid()) finest.push_back(model.faceOf[t]);
  std::ranges::sort(finest);
  const auto isThere = [&](std::uint32_t face) { return std::ranges::binary_search(finest, face); };
  std::uint64_t next = 0;
  for (const auto& [face, in] : model.leftOutFaces) {
    if (face >= model.sourceFaces || in >= model.sourceFaces)
      return refuse("a face that was left out lies in one that the source does not have");
    if (face < next) return refuse("the faces that were left out are not in the order of their numbers");
    if (isThere(face)) return refuse(fmt::format("face {} is left out and is there", face));
    if (!isThere(in)) return refuse(fmt::format("face {} lies in face {}, which is not there", face, in));
    next = std::uint64_t{face} + 1;
  }
  return {};
}

}  // namespace

bool SurfaceModel::mayHaveLines() const {
  return hasWedges() || !partsOf(attributes, std::size_t{faceCount()}).empty();
}

Status SurfaceModel::validate() const {
  const MeshAttributes& a = attributes;
  if (mt.vertices().hasPlan() && mt.vertexCount() > 0) return refuse("its vertices are not of a surface");
  if (vertexOf.size() != mt.vertexCount())
    return refuse(fmt::format("{} {} in the source", counted(mt.vertexCount(), "vertex has", "vertices have"),
                              counted(vertexOf.size(), "number", "numbers")));
  if (faceOf.size() != mt.triangleIdCount() || (hasWedges() && wedgesOf.size() != mt.triangleIdCount()))
    return refuse("not every triangle has a face and wedges");
  if (!displacement.isEmpty() && (displacement.directions.size() != mt.vertexCount() ||
                                  displacement.reaches.size() != mt.triangleIdCount()))
    return refuse("its displacement is of another number of vertices or triangles");
  for (const AttributeErrors& errors : attributeErrors)
    if (errors.codes.size() != (1 + attributeDistances.size()) * mt.triangleIdCount())
      return refuse(fmt::format("the errors of {} are of another number of triangles", errors.name));
  for (std::size_t i = 0; i < attributeDistances.size(); ++i)
    if (!(attributeDistances[i] > (i > 0 ? attributeDistances[i - 1] : 0)) ||
        !std::isfinite(attributeDistances[i]))
      return refuse("the distances of its attribute errors do not rise");
  if (hasWedges() == (a.wedgeCount == 0))
    return refuse("wedges are counted and not listed, or the other way");
  for (const Attribute& attribute : a.vertexAttributes)
    ARETE_CHECK(checkAttribute(attribute, mt.vertexCount()));
  for (const Attribute& attribute : a.wedgeAttributes) ARETE_CHECK(checkAttribute(attribute, a.wedgeCount));
  for (const Attribute& attribute : a.triangleAttributes) ARETE_CHECK(checkAttribute(attribute, faceCount()));
  const auto isListOf = [&](const std::vector<std::uint32_t>& numbers, std::size_t count) {
    if (numbers.empty()) return true;
    return numbers.size() == faceCount() && std::ranges::all_of(numbers, [&](std::uint32_t i) {
             return i < count || i == MeshAttributes::kNone;
           });
  };
  if (!isListOf(a.objectOf, a.objects.size()) || !isListOf(a.groupOf, a.groups.size()) ||
      !isListOf(a.materialOf, a.materials.size()))
    return refuse("a face has an object, group or material that there is not");
  if (std::ranges::any_of(vertexOf, [&](std::uint32_t v) { return v >= sourceVertices; }))
    return refuse("a vertex has a number that the source does not have");
  if (std::ranges::any_of(faceOf, [&](std::uint32_t f) { return f >= faceCount(); }))
    return refuse("a triangle has a face that the source does not have");
  ARETE_CHECK(checkLeftOutFaces(*this));
  for (const auto& wedges : wedgesOf)
    for (const std::uint32_t w : wedges)
      if (w >= a.wedgeCount) return refuse(fmt::format("a corner has wedge {} of {}", w, a.wedgeCount));
  return {};
}

std::vector<double> sharesOfDiagonal(const SurfaceModel& model) {
  std::vector<double> errors;
  for (const double percent : {0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0})
    if (const double error = percent / 100 * model.diagonal; error < model.mt.largestError())
      errors.push_back(error);
  return errors;
}

}  // namespace arete
