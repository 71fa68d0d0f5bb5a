// SPDX-License-Identifier: GPL-3.0-or-later
//
// The primitives of an object share their vertices, so that a vertex of two materials stays one. Objects do
// not, since readers load each with all the vertices that its accessors have: a vertex of two objects becomes
// two.
#include "io/formats/glb/writer/mesh_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "io/files/text_scan.h"

namespace arete {
namespace {

/// An object for each that has triangles.
std::vector<ObjectPlan> distributed(const SurfaceMesh& mesh) {
  // By object, none being the first: its primitives by material.
  std::vector<ObjectPlan> plans(mesh.objects.size() + 1);
  std::vector<std::map<std::uint32_t, std::size_t>> primitiveOf(plans.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t object = mesh.objectOf.empty() ? MeshAttributes::kNone : mesh.objectOf[t];
    const std::uint32_t material = mesh.materialOf.empty() ? MeshAttributes::kNone : mesh.materialOf[t];
    const std::size_t at = object == MeshAttributes::kNone ? 0 : std::size_t{object} + 1;
    auto& primitives = plans[at].primitives;
    const auto [found, isNew] = primitiveOf[at].try_emplace(material, primitives.size());
    if (isNew) primitives.push_back({.material = material, .triangles = {}});
    primitives[found->second].triangles.push_back(t);
  }
  for (std::size_t i = 0; i < mesh.objects.size(); ++i) plans[i + 1].name = mesh.objects[i];
  return plans;
}

/// Lists the vertices of each object.
/// @return By vertex, in how many objects it is.
std::vector<std::uint32_t> listVertices(const SurfaceMesh& mesh, std::vector<ObjectPlan>& objects) {
  std::vector<std::uint32_t> uses(mesh.positions.size()),
      lastObject(mesh.positions.size(), MeshAttributes::kNone);
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    for (const PrimitivePlan& primitive : objects[i].primitives)
      for (const std::uint32_t t : primitive.triangles)
        for (const std::uint32_t v : mesh.triangles[t]) {
          if (lastObject[v] == i) continue;
          lastObject[v] = i;
          ++uses[v];
          objects[i].vertices.push_back(v);
        }
    std::ranges::sort(objects[i].vertices);
  }
  return uses;
}

}  // namespace

MeshPlan planMeshes(const SurfaceMesh& mesh) {
  MeshPlan plan{.objects = distributed(mesh), .lost = {}};
  std::string empty;
  for (std::size_t i = 1; i < plan.objects.size(); ++i)
    if (plan.objects[i].primitives.empty())
      empty += (empty.empty() ? "" : ", ") + text::quotedToken(plan.objects[i].name);
  if (!empty.empty()) plan.lost.push_back(fmt::format("objects without faces ({})", empty));
  std::erase_if(plan.objects, [](const ObjectPlan& object) { return object.primitives.empty(); });
  if (plan.objects.size() <= 1) {
    if (plan.objects.empty() && !mesh.positions.empty()) plan.lost.push_back("vertices without faces");
    return plan;
  }
  const std::vector<std::uint32_t> uses = listVertices(mesh, plan.objects);
  if (const auto unused = std::ranges::count(uses, 0u); unused > 0)
    plan.lost.push_back(fmt::format("vertices without faces beside several objects ({})", unused));
  if (const auto shared = std::ranges::count_if(uses, [](std::uint32_t n) { return n > 1; }); shared > 0)
    plan.lost.push_back(fmt::format("vertices that several objects share ({} are written for each)", shared));
  return plan;
}

}  // namespace arete
