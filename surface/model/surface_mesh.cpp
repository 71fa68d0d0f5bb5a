// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/model/surface_mesh.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/caught_failure.h"
#include "engine/base/counted.h"

namespace arete {
namespace {

Status checkNumbers(const std::vector<std::uint32_t>& numbers, std::size_t triangles, std::size_t count,
                    const char* what) {
  if (!numbers.empty() && numbers.size() != triangles)
    return failure(ErrorCode::invalidData,
                   fmt::format("{} a {}, of {}", counted(numbers.size(), "triangle has", "triangles have"),
                               what, triangles));
  for (std::size_t t = 0; t < numbers.size(); ++t)
    if (numbers[t] != SurfaceMesh::kNone && numbers[t] >= count)
      return failure(ErrorCode::invalidData,
                     fmt::format("triangle {} has {} {}, of {}", t, what, numbers[t], count));
  return {};
}

Status checkAttributes(const std::vector<Attribute>& attributes, std::size_t elements) {
  for (const Attribute& attribute : attributes) {
    ARETE_CHECK(checkAttribute(attribute, elements));
    if (std::ranges::count(attributes, attribute.name, &Attribute::name) != 1)
      return failure(ErrorCode::invalidData, fmt::format("there are two attributes '{}'", attribute.name));
  }
  return {};
}

}  // namespace

MeshRef::MeshRef(const TriangleMesh& mesh)
    : shape(mesh), attributes([]() -> const MeshAttributes& {
        static const MeshAttributes none;
        return none;
      }()) {}

Status SurfaceMesh::validate() const {
  return MeshRef(*this).validate();
}

Status MeshRef::validate() const try {
  const MeshAttributes& of = attributes;
  const std::size_t triangles = shape.triangles.size();
  ARETE_CHECK(shape.validate());
  ARETE_CHECK(checkAttributes(of.vertexAttributes, shape.positions.size()));
  ARETE_CHECK(checkAttributes(of.wedgeAttributes, of.wedgeCount));
  ARETE_CHECK(checkAttributes(of.triangleAttributes, triangles));
  if (of.hasWedges() && of.wedges.size() != triangles)
    return failure(ErrorCode::invalidData,
                   fmt::format("{} wedges, of {}",
                               counted(of.wedges.size(), "triangle has", "triangles have"), triangles));
  if (!of.hasWedges() && triangles > 0 && !of.wedgeAttributes.empty())
    return failure(ErrorCode::invalidData, "there are attributes of wedges and no wedges");
  for (std::size_t t = 0; t < of.wedges.size(); ++t)
    for (const std::uint32_t wedge : of.wedges[t])
      if (wedge >= of.wedgeCount)
        return failure(ErrorCode::invalidData,
                       fmt::format("triangle {} has wedge {}, of {}", t, wedge, of.wedgeCount));
  if (!of.faceOf.empty() && of.faceOf.size() != triangles)
    return failure(ErrorCode::invalidData,
                   fmt::format("{} a face, of {}",
                               counted(of.faceOf.size(), "triangle has", "triangles have"), triangles));
  ARETE_CHECK(checkNumbers(of.objectOf, triangles, of.objects.size(), "object"));
  ARETE_CHECK(checkNumbers(of.groupOf, triangles, of.groups.size(), "group"));
  return checkNumbers(of.materialOf, triangles, of.materials.size(), "material");
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
