// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/result.h"
#include "io/exchange/mesh_formats.h"

namespace arete {

/// Two meshes in one geographic CRS, made comparable in space.
struct MetricMeshes {
  TriangleMesh first, second;    ///< metres: east, north, up
  Vec3 firstUnits, secondUnits;  ///< metres in what the files count in
  double latitude = 0;           ///< where the ground size was taken, in the unit of the CRS
};

/// Turns degrees into metres by the ground size that they have in the middle of both meshes, and heights into
/// metres by their unit (metres where the files say none). Away from that latitude lengths to the east are
/// off by as much as its cosine changes. Precondition: isGeographicCrs() of both. Errors: usage, unsupported
/// (a CRS that cannot be understood). O(vertices).
Result<MetricMeshes> toMetres(const MeshFile& first, const MeshFile& second);

}  // namespace arete
