// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/box3.h"
#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "surface/model/surface_mesh.h"

namespace arete {

struct CropOptions {
  /// Triangles that touch the box stay whole; else they are cut at its faces.
  bool keepsWhole = false;
};

/// The part of a mesh in a box.
struct CroppedMesh {
  SurfaceMesh mesh;
  std::vector<std::uint32_t> vertexOf;    ///< by vertex: that of the source; kNone: a cut made it
  std::vector<std::uint32_t> triangleOf;  ///< by triangle: the one of the source that it is or is a part of
  std::uint64_t cutTriangles = 0;         ///< of the source
  std::uint64_t cutVertices = 0;          ///< of the result, made by cuts
};

/// The part of a mesh in a box, with its attributes. Vertices and triangles keep their order; vertices that a
/// cut makes follow, and the pieces of a triangle take its place. Borders are open: nothing closes them.
///
/// A vertex on a face of the box has the coordinate of the face to the bit. Neighbours that shared an edge
/// share what is left of it. A cut of an edge depends on the ends of the edge and on the face alone, and one
/// within a triangle on the triangle and two faces, so that the parts in two boxes that share a whole face
/// meet there to the bit. A triangle that lies in a face belongs to both.
///
/// Where an edge is cut, attributes are interpolated; labels are those of the nearer end
/// (surface/model/average.h). faceOf is left out, and so are objects, groups, materials and pictures in the
/// mesh that are used no more.
///
/// Errors: invalidData: SurfaceMesh::validate(). usage, culprit `box`: a bound is NaN, or a lower bound is
/// not below the upper one; nothing of the mesh is in the box. interrupted, outOfMemory. O(size).
Result<CroppedMesh> crop(const SurfaceMesh& mesh, const Box3& box, const CropOptions& options = {},
                         const RunContext& context = {});

}  // namespace arete
