// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/result.h"
#include "engine/base/similarity.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// Scales, turns and moves a mesh: its positions, and the directions among its attributes (normals and
/// tangents of vertices, corners and faces), which are turned alone. All else stays. Attributes that nothing
/// turns stay to the bit.
///
/// Errors: invalidData: a position is beyond what a double holds, culprit the vertex; the mesh is then half
/// placed. Precondition: the mesh is valid, the placing does not mirror. O(size).
Status place(SurfaceMesh& mesh, const Similarity& placing);

/// A similarity of a space whose z points up, in coordinates of which y points up: x, -z and y there are x, y
/// and z.
Similarity withYUp(const Similarity& zUp);

}  // namespace arete
