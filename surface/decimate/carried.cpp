// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/decimate/carried.h"

#include <utility>

namespace arete {
namespace {

std::vector<Attribute> taken(const std::vector<Attribute>& attributes,
                             const std::vector<std::uint32_t>& elements) {
  std::vector<Attribute> result;
  for (const Attribute& attribute : attributes) {
    result.push_back(emptyLike(attribute));
    for (const std::uint32_t e : elements) result.back().append(attribute.element(e));
  }
  return result;
}

std::vector<std::uint32_t> taken(const std::vector<std::uint32_t>& numbers,
                                 const std::vector<std::uint32_t>& elements) {
  std::vector<std::uint32_t> result;
  if (numbers.empty()) return result;
  for (const std::uint32_t e : elements) result.push_back(numbers[e]);
  return result;
}

}  // namespace

DecimatedMesh carried(const SurfaceMesh& source, TriangleMesh shape, std::vector<std::uint32_t> vertexOf,
                      std::vector<std::uint32_t> faceOf) {
  DecimatedMesh result;
  SurfaceMesh& mesh = result.mesh;
  mesh.shape() = std::move(shape);
  mesh.vertexAttributes = taken(source.vertexAttributes, vertexOf);
  mesh.triangleAttributes = taken(source.triangleAttributes, faceOf);
  mesh.objectOf = taken(source.objectOf, faceOf);
  mesh.groupOf = taken(source.groupOf, faceOf);
  mesh.materialOf = taken(source.materialOf, faceOf);
  mesh.objects = source.objects;
  mesh.groups = source.groups;
  mesh.materials = source.materials;
  mesh.pictures = source.pictures;
  result.vertexOf = std::move(vertexOf);
  result.faceOf = std::move(faceOf);
  return result;
}

}  // namespace arete
