// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export_tin.h"

#include <utility>

#include "io/local_origin.h"

namespace arete {

TinExport exportTin(const TerrainModel& model, const Cut& cut) {
  TinExport tin;
  const auto toSource = [&](std::uint32_t v) {
    const Vec3 p = model.mt.position(VertexId(v));
    const Vec2 xy = model.toSource({p.x, p.y});
    return Vec3{xy.x, xy.y, p.z};
  };
  tin.mesh.positions.reserve(cut.vertices.size());
  for (const std::uint32_t v : cut.vertices) tin.mesh.positions.push_back(toSource(v));
  tin.mesh.triangles = cut.triangles;
  if (model.isFlipped())
    for (auto& t : tin.mesh.triangles) std::swap(t[1], t[2]);
  tin.errors.reserve(cut.ids.size());
  for (const std::uint32_t t : cut.ids)
    tin.errors.push_back(static_cast<float>(model.mt.error(TriangleId(t))));
  // Of the root, which is in every cut.
  std::vector<Vec3> root(model.mt.rootVertexCount());
  for (std::uint32_t v = 0; v < root.size(); ++v) root[v] = toSource(v);
  tin.origin = localOrigin(root);
  return tin;
}

}  // namespace arete
