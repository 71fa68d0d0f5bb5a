// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/result.h"
#include "io/formats/exchange/mesh_formats.h"

namespace arete {

/// Two meshes in a geographic CRS, converted to metres.
struct MetricMeshes {
  TriangleMesh first, second;    ///< metres: east, north, up
  Vec3 firstUnits, secondUnits;  ///< metres per unit of the files
  double latitude = 0;           ///< at which the ground size was evaluated, in the unit of the CRS
};

/// Converts degrees to metres by their ground size at the middle latitude of both meshes, and heights to
/// metres by their unit (default: metres). Away from that latitude, lengths to the east have a relative error
/// of the change of the cosine. Precondition: isGeographicCrs() of both.
///
/// Errors: usage, unsupported: GDAL does not understand the CRS. O(vertices).
Result<MetricMeshes> toMetres(const MeshFile& first, const MeshFile& second);

}  // namespace arete
