// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "surface/model/surface_mesh.h"

namespace arete {

/// Directions of corners that differ by less are one: no picture can show it, and exporters write the normal
/// of each face's corner with a last digit of its own.
inline constexpr double kSameDirection = 1e-4;

/// Makes the normals and tangents of the corners at each vertex equal where they agree within kSameDirection:
/// the later one becomes the earlier one, to the bit, and equal wedges of a vertex become one. Nothing else
/// changes. O(n log n). Precondition: the mesh is valid.
/// @return how many wedges there are fewer.
std::uint64_t joinAgreeingNormals(SurfaceMesh& mesh);

/// Leaves out the normals and tangents of corners where they are those of flat faces: they differ at more
/// than half of the edges, and nearly all faces have one normal. There they say no more than the faces do,
/// and would fix every vertex. O(n log n). Precondition: the mesh is valid.
/// @return whether they are left out.
bool dropFlatNormals(SurfaceMesh& mesh);

/// An attribute of corners, and at how many edges it differs from side to side.
struct SeamAttribute {
  std::string name;
  std::uint64_t edges = 0;
};

/// The attributes of corners that differ across edges, those of most edges first. O(n log n) for each.
std::vector<SeamAttribute> seamAttributes(const SurfaceMesh& mesh);

}  // namespace arete
