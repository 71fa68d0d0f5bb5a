// SPDX-License-Identifier: GPL-3.0-or-later
//
// One scale per axis for both meshes, so that their distances are comparable.
#include "io/formats/exchange/metric_mesh.h"

#include <algorithm>
#include <limits>

#include "engine/base/caught_failure.h"
#include "io/geo/crs/reader.h"
#include "terrain/model/georeference.h"

namespace arete {
namespace {

TriangleMesh scaled(const TriangleMesh& mesh, const Vec3& by) {
  TriangleMesh result = mesh;
  for (Vec3& p : result.positions) p = {p.x * by.x, p.y * by.y, p.z * by.z};
  return result;
}

double heightMetres(const MeshFile& mesh, const Georeference& georeference) {
  return metresPerUnit(mesh.verticalUnit).value_or(georeference.verticalUnitMetres);
}

}  // namespace

Result<MetricMeshes> toMetres(const MeshFile& first, const MeshFile& second) try {
  ARETE_TRY(const auto crs, crsFromText(first.crsWkt));
  Georeference axes;
  ARETE_CHECK(describeCrs(crs, axes));
  double south = std::numeric_limits<double>::infinity(), north = -south;
  for (const MeshFile* file : {&first, &second})
    for (const Vec3& p : file->mesh.positions) {
      south = std::min(south, p.y);
      north = std::max(north, p.y);
    }
  const double latitude = (south + north) / 2;
  const Vec2 unit = groundUnit(axes, latitude);
  const Vec3 firstUnits{unit.x, unit.y, heightMetres(first, axes)},
      secondUnits{unit.x, unit.y, heightMetres(second, axes)};
  return MetricMeshes{scaled(first.mesh, firstUnits), scaled(second.mesh, secondUnits), firstUnits,
                      secondUnits, latitude};
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
