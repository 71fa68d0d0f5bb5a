// SPDX-License-Identifier: GPL-3.0-or-later
//
// The origin comes from the vertices of the root, which are in every cut.
#include "io/formats/exchange/export_tin.h"

#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/memory/pages.h"
#include "io/geo/crs/local_origin.h"

namespace arete {

Result<TinExport> exportTin(const TerrainModel& model, const Cut& cut) try {
  TinExport tin;
  const auto toSource = [&](std::uint32_t v) {
    const Vec3 p = model.mt.position(VertexId(v));
    const Vec2 xy = model.toSource({p.x, p.y});
    return Vec3{xy.x, xy.y, p.z};
  };
  reserveInPages(tin.mesh.positions, cut.vertices.size());
  for (const std::uint32_t v : cut.vertices) tin.mesh.positions.push_back(toSource(v));
  reserveInPages(tin.mesh.triangles, cut.triangles.size());
  tin.mesh.triangles = cut.triangles;
  if (model.isFlipped())
    for (auto& t : tin.mesh.triangles) std::swap(t[1], t[2]);
  reserveInPages(tin.errors, cut.ids.size());
  for (const std::uint32_t t : cut.ids)
    tin.errors.push_back(static_cast<float>(model.mt.error(TriangleId(t))));
  tin.vertexOf = cut.vertices;
  // Of the root, which is in every cut.
  std::vector<Vec3> root(model.mt.rootVertexCount());
  for (std::uint32_t v = 0; v < root.size(); ++v) root[v] = toSource(v);
  tin.origin = localOrigin(root);
  return tin;
} catch (...) {
  return caughtFailure();
}

Result<TinExport> exportTin(const TerrainModel& model, const FittedCut& fitted) try {
  Result<TinExport> exported = exportTin(model, fitted.cut);
  if (!exported) return exported;
  TinExport& tin = *exported;
  for (std::size_t v = 0; v < fitted.heights.size(); ++v) tin.mesh.positions[v].z = fitted.heights[v];
  for (std::size_t t = 0; t < fitted.errors.size(); ++t) {
    tin.errors[t] = static_cast<float>(fitted.errors[t]);
    if (tin.errors[t] < fitted.errors[t])
      tin.errors[t] = std::nextafter(tin.errors[t], std::numeric_limits<float>::infinity());
  }
  return exported;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
