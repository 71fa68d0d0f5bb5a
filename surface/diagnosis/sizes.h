// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/triangle_mesh.h"

namespace arete {

/// The sum of the areas of the triangles. O(triangles). Precondition: the mesh is valid.
double areaOf(const TriangleMesh& mesh);

/// What a closed mesh encloses, whose triangles are counter-clockwise seen from outside; negative if they
/// turn the other way. Of a mesh that is not closed or does not turn alike everywhere, a number without a
/// meaning. Relative to the middle of the mesh, so that it is as exact far from the origin. O(triangles).
/// Precondition: the mesh is valid.
double volumeOf(const TriangleMesh& mesh);

}  // namespace arete
