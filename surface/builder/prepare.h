// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "surface/model/surface_mesh.h"
#include "surface/model/surface_model.h"

namespace arete {

/// A mesh that a build can take: an oriented manifold, perhaps with borders.
struct PreparedSurface {
  /// Without what belongs to faces, objects and materials: see ofSource.
  SurfaceMesh mesh;
  /// Attributes of triangles, objects, groups and materials, by triangle of the source; names and pictures.
  MeshAttributes ofSource;
  std::vector<std::uint32_t> partOf;  ///< by triangle: SurfaceParts::partOf
  std::uint64_t sourceVertices = 0, sourceFaces = 0;
  Vec3 boxLow, boxHigh;                 ///< of the mesh
  double diagonal = 0;                  ///< of that box
  std::vector<std::uint32_t> vertexOf;  ///< by vertex: that of the source
  std::vector<std::uint32_t> faceOf;    ///< by triangle: that of the source
  std::vector<SurfaceModel::LeftOutFace> leftOutFaces;
  SurfaceRepairs mending;
};

/// Mends what leaves the surface as it is (SurfaceRepairs), as repair() does, and refuses what does not:
/// edges of more than two faces and parts that no turns orient. Errors: those of repair(); invalidData: names
/// the first such edge by the vertices of the source, how many there are, and what mends them; degenerate: no
/// face has an area. O(n log n).
Result<PreparedSurface> prepareSurface(SurfaceMesh source, const RunContext& context = {});

}  // namespace arete
