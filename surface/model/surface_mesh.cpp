// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/model/surface_mesh.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/caught_failure.h"

namespace arete {
namespace {

Status checkNumbers(const std::vector<std::uint32_t> &numbers,
                    std::size_t triangles, std::size_t count,
                    const char *what) {
  if (!numbers.empty() && numbers.size() != triangles)
    return failure(ErrorCode::invalidData,
                   fmt::format("{} triangles have a {}, of {}", numbers.size(),
                               what, triangles));
  for (std::size_t t = 0; t < numbers.size(); ++t)
    if (numbers[t] != SurfaceMesh::kNone && numbers[t] >= count)
      return failure(ErrorCode::invalidData,
                     fmt::format("triangle {} has {} {}, of {}", t, what,
                                 numbers[t], count));
  return {};
}

Status checkAttributes(const std::vector<Attribute> &attributes,
                       std::size_t elements) {
  for (const Attribute &attribute : attributes) {
    if (Status valid = checkAttribute(attribute, elements); !valid)
      return valid;
    if (std::ranges::count(attributes, attribute.name, &Attribute::name) != 1)
      return failure(
          ErrorCode::invalidData,
          fmt::format("there are two attributes '{}'", attribute.name));
  }
  return {};
}

} // namespace

Status SurfaceMesh::validate() const try {
  const std::size_t triangles = shape.triangles.size();
  if (Status valid = shape.validate(); !valid)
    return valid;
  if (Status valid = checkAttributes(vertexAttributes, shape.positions.size());
      !valid)
    return valid;
  if (Status valid = checkAttributes(wedgeAttributes, wedgeCount); !valid)
    return valid;
  if (Status valid = checkAttributes(triangleAttributes, triangles); !valid)
    return valid;
  if (hasWedges() && wedges.size() != triangles)
    return failure(ErrorCode::invalidData,
                   fmt::format("{} triangles have wedges, of {}", wedges.size(),
                               triangles));
  if (!hasWedges() && triangles > 0 && !wedgeAttributes.empty())
    return failure(ErrorCode::invalidData,
                   "there are attributes of wedges and no wedges");
  for (std::size_t t = 0; t < wedges.size(); ++t)
    for (const std::uint32_t wedge : wedges[t])
      if (wedge >= wedgeCount)
        return failure(ErrorCode::invalidData,
                       fmt::format("triangle {} has wedge {}, of {}", t, wedge,
                                   wedgeCount));
  if (!faceOf.empty() && faceOf.size() != triangles)
    return failure(ErrorCode::invalidData,
                   fmt::format("{} triangles have a face, of {}", faceOf.size(),
                               triangles));
  if (Status valid =
          checkNumbers(objectOf, triangles, objects.size(), "object");
      !valid)
    return valid;
  if (Status valid = checkNumbers(groupOf, triangles, groups.size(), "group");
      !valid)
    return valid;
  return checkNumbers(materialOf, triangles, materials.size(), "material");
} catch (...) {
  return caughtFailure();
}

bool SurfaceMesh::operator==(const SurfaceMesh &o) const {
  return shape.positions == o.shape.positions &&
         shape.triangles == o.shape.triangles &&
         vertexAttributes == o.vertexAttributes &&
         wedgeAttributes == o.wedgeAttributes &&
         triangleAttributes == o.triangleAttributes &&
         wedgeCount == o.wedgeCount && wedges == o.wedges &&
         faceOf == o.faceOf && objects == o.objects && groups == o.groups &&
         objectOf == o.objectOf && groupOf == o.groupOf &&
         materials == o.materials && materialOf == o.materialOf &&
         pictures == o.pictures;
}

} // namespace arete
