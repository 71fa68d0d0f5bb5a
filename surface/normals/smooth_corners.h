// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/crease.h"
#include "engine/base/triangle_mesh.h"

namespace arete {

/// Normals of corners, which corners share.
struct CornerNormals {
  std::vector<Vec3> normals;                           ///< of length 1, or zero where no face has an area
  std::vector<std::array<std::uint32_t, 3>> normalOf;  ///< by triangle: of its corners
};

/// One normal for all corners of a triangle, zero where it has no area. O(triangles).
CornerNormals flatCorners(const TriangleMesh& mesh);

/// The normals of faces, of length 1. A triangle that is thinner than the numbers of the mesh has that of the
/// face at its longest edge; zero where there is none. Precondition: as smoothCorners(). O(n log n).
std::vector<Vec3> faceNormals(const TriangleMesh& mesh);

/// The corners around a vertex that no hard edge parts have one normal: the sum of the normals of their faces
/// by the angles of the faces at the vertex [ThurmerWuthrich1998]. So the diagonals of a plane face do not
/// count. An edge is hard where isCrease() says so, where it is a border, where its faces are not oriented
/// alike, and at an end where the stated normals of both sides differ by more than a degree. Vertices at one
/// place are one: seams of attributes part nothing. Of an edge of more than two faces the most level pairs of
/// faces go on smoothly. A triangle that is thinner than the numbers of the mesh has no normal of its own: it
/// hands on what the face at its longest edge has. Where normals cancel, corners have what their faces have.
///
/// @param stated  empty, or three a triangle: the normals of the file, zero where it states none.
/// Precondition: indices are valid, positions finite. O(n log n).
CornerNormals smoothCorners(const TriangleMesh& mesh, double creaseDegrees,
                            std::span<const Vec3> stated = {});

}  // namespace arete
