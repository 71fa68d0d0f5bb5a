// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/triangle_mesh.h"
#include "surface/decimate/quadric.h"
#include "surface/model/surface_mesh.h"
#include "surface/topology/edges.h"

namespace arete {

/// What vertices have before anything is contracted.
struct MeshQuadrics {
  /// Of the planes of its triangles, and of planes that stand on the triangles at its edges on borders and on
  /// lines between wedges or parts, so that these stay where they are.
  std::vector<Quadric> ofVertex;
  std::vector<std::uint8_t> isOnBorder;  ///< by vertex: 1 or 0
};

/// Whether wedges or parts differ across an edge of two triangles.
bool isLine(const SurfaceMesh& source, const std::vector<std::uint32_t>& partOf, const MeshEdges::Edge& edge);

/// O(n log n).
/// @param shape   of the source, in the frame of the quadrics
/// @param partOf  by triangle: partsOf() the source
/// @param weighsByArea  planes count by the area of their triangles; otherwise all alike
MeshQuadrics quadricsOf(const SurfaceMesh& source, const TriangleMesh& shape,
                        const std::vector<std::uint32_t>& partOf, bool weighsByArea);

}  // namespace arete
