// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/front/front.h"

#include <limits>

namespace arete {
namespace {

constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

/// Attributes of some elements, in their order.
std::vector<Attribute> taken(const std::vector<Attribute>& attributes,
                             const std::vector<std::uint32_t>& elements) {
  std::vector<Attribute> some;
  for (const Attribute& attribute : attributes) {
    Attribute& to = some.emplace_back(emptyLike(attribute));
    for (const std::uint32_t i : elements) to.append(attribute.element(i));
  }
  return some;
}

std::vector<std::uint32_t> taken(const std::vector<std::uint32_t>& numbers,
                                 const std::vector<std::uint32_t>& elements) {
  std::vector<std::uint32_t> some;
  if (!numbers.empty())
    for (const std::uint32_t i : elements) some.push_back(numbers[i]);
  return some;
}

/// The wedges that the triangles use, numbered by their first use.
void takeWedges(const SurfaceModel& model, const Cut& cut, SurfaceMesh& mesh) {
  std::vector<std::uint32_t> numberOf(model.attributes.wedgeCount, kNoVertex), used;
  for (const std::uint32_t id : cut.ids) {
    auto& wedges = mesh.wedges.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t& number = numberOf[model.wedgesOf[id][i]];
      if (number == kNoVertex) {
        number = static_cast<std::uint32_t>(used.size());
        used.push_back(model.wedgesOf[id][i]);
      }
      wedges[i] = number;
    }
  }
  mesh.wedgeCount = static_cast<std::uint32_t>(used.size());
  mesh.wedgeAttributes = taken(model.attributes.wedgeAttributes, used);
}

}  // namespace

SurfaceFront surfaceOf(const SurfaceModel& model, const Cut& cut) {
  SurfaceFront front;
  SurfaceMesh& mesh = front.mesh;
  mesh.triangles = cut.triangles;
  for (const std::uint32_t v : cut.vertices) {
    mesh.positions.push_back(model.mt.position(VertexId(v)));
    front.vertexOf.push_back(model.vertexOf[v]);
  }
  for (const std::uint32_t id : cut.ids) {
    front.faceOf.push_back(model.faceOf[id]);
    front.errors.push_back(static_cast<float>(model.mt.error(TriangleId(id))));
  }
  const MeshAttributes& a = model.attributes;
  mesh.vertexAttributes = taken(a.vertexAttributes, cut.vertices);
  if (model.hasWedges()) takeWedges(model, cut, mesh);
  mesh.triangleAttributes = taken(a.triangleAttributes, front.faceOf);
  mesh.objects = a.objects;
  mesh.groups = a.groups;
  mesh.objectOf = taken(a.objectOf, front.faceOf);
  mesh.groupOf = taken(a.groupOf, front.faceOf);
  mesh.materials = a.materials;
  mesh.materialOf = taken(a.materialOf, front.faceOf);
  mesh.pictures = a.pictures;
  return front;
}

SurfaceFront finestSurfaceOf(const SurfaceModel& model) {
  return surfaceOf(model, frontOfPrefix(model.mt, model.mt.nodeCount()));
}

}  // namespace arete
