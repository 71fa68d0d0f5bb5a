// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/base/vec.h"
#include "engine/parallel/run_context.h"
#include "viewer/scene/layer.h"

namespace arete {

/// How far drawn vertices of one surface are from another surface, at full resolution.
struct VertexDistances {
  std::vector<float> distances;  ///< by drawn vertex
  double largest = 0, mean = 0;  ///< the mean of the vertices, not of the area
};

/// @param positions of the drawn vertices, in the space of the mesh. Precondition: the mesh has a triangle.
/// O(vertices log n), parallel. Errors: interrupted.
Result<VertexDistances> distancesTo(const TriangleMesh& other, const std::vector<Vec3>& positions,
                                    const RunContext& context = {});

/// Four bytes a vertex: the colours of the table "error" from 0 to `most`; dark and whole for `most` 0.
std::vector<std::uint8_t> distanceColors(const VertexDistances& of, double most);
/// What the colours mean, in the unit of the file.
Legend distanceLegend(double most, const std::string& unit);

/// The name of the layer that has the legend: distances of vertices to the other surface.
inline constexpr const char* kDistanceLayer = "vertices to the other";

}  // namespace arete
