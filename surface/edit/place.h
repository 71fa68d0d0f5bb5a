// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

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

/// Turns the directions among the attributes of a mesh: the first three components of normals and tangents.
/// O(size).
void turnDirections(SurfaceMesh& mesh, const std::function<Vec3(const Vec3&)>& turn);

/// A similarity of a space whose z points up, in coordinates of which y points up: x, -z and y there are x, y
/// and z.
Similarity withYUp(const Similarity& zUp);

}  // namespace arete
