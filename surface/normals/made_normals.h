// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/crease.h"
#include "engine/base/result.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// What becomes of the normals of a mesh.
enum class NormalsKind : std::uint8_t {
  keep,    ///< as stated
  flat,    ///< of its triangle at each corner
  smooth,  ///< smoothCorners()
};

struct NormalsOptions {
  NormalsKind kind = NormalsKind::keep;
  double creaseAngleDegrees = kCreaseDegrees;  ///< of smooth ones: 0..180
  bool operator==(const NormalsOptions&) const = default;
};

/// What makeNormals() did.
struct MadeNormals {
  bool leavesOutTangents = false;  ///< they belonged to the former normals
};

/// Replaces the normals of vertices and corners. Smooth ones are hard where the mesh's own are, unless these
/// are all flat: then they say no more than the faces. Normals are floats; a vertex whose corners agree has
/// one, others have wedges. Where no face has an area, and at vertices without a face, it is 0, 0, 1.
/// Tangents are left out. Errors: usage: the angle is not within 0..180; as SurfaceMesh::validate();
/// outOfMemory. O(n log n).
Result<MadeNormals> makeNormals(SurfaceMesh& mesh, const NormalsOptions& options);

}  // namespace arete
