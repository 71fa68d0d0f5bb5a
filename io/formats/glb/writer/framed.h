// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "io/formats/common/file.h"
#include "io/formats/glb/frame.h"
#include "io/formats/glb/writer/container.h"

namespace arete {

using Float3 = std::array<float, 3>;

/// The positions of a mesh as a glTF of Arete's own frame has them: metres, y up.
struct FramedPositions {
  GlbFrame frame;  ///< goes to asset.extras.arete
  std::vector<Float3> positions;
  bool areAlike = false;  ///< the frame only moves and turns, and scales all axes alike
};

/// Errors: usage: a CRS that GDAL does not understand. invalidData: a latitude beyond the pole, a position
/// beyond 32-bit floats. O(vertices).
Result<FramedPositions> framedPositions(const TriangleMesh& mesh, const MeshWriteOptions& options);

/// The normalized sum of the cross products of the triangles around each vertex, so larger triangles weigh
/// more. (0, 1, 0) where it is zero. O(size).
std::vector<Float3> normalsOf(const TriangleMesh& mesh, std::span<const Float3> positions);

/// By vertex: the largest error of its triangles; empty without errors.
std::vector<float> vertexErrors(const TriangleMesh& mesh, std::span<const float> triangleErrors);

/// The smallest and the largest coordinates, never -0: some readers do not take "-0.0" and "0.0" as equal.
std::array<Float3, 2> boxOf(std::span<const Float3> positions);

/// The material of a terrain without attributes.
nlohmann::ordered_json groundMaterial();

/// A mesh of terrain without attributes: positions, normals, errors and indices, in this order. The arguments
/// must outlive the content.
GltfContent terrainContent(const TriangleMesh& mesh, const FramedPositions& framed,
                           const std::vector<float>& errors);

}  // namespace arete
