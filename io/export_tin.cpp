// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export_tin.h"

#include <utility>

namespace arete {

TinExport exportTin(const TerrainModel& model, const Cut& cut) {
  TinExport tin;
  tin.mesh.positions.reserve(cut.vertices.size());
  for (const std::uint32_t v : cut.vertices) {
    const Vec3 p = model.mt.position(VertexId(v));
    const Vec2 xy = model.toSource({p.x, p.y});
    tin.mesh.positions.push_back({xy.x, xy.y, p.z});
  }
  tin.mesh.triangles = cut.triangles;
  if (model.isFlipped())
    for (auto& t : tin.mesh.triangles) std::swap(t[1], t[2]);
  tin.errors.reserve(cut.ids.size());
  for (const std::uint32_t t : cut.ids)
    tin.errors.push_back(static_cast<float>(model.mt.error(TriangleId(t))));
  return tin;
}

}  // namespace arete
