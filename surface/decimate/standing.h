// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/decimate/contractions.h"

namespace arete {

/// Follows the vertices to where the last of them stays. O(n)
void follow(std::vector<std::uint32_t>& joinedTo);

/// By face of the source: the triangle of the result that stands for it (DecimatedMesh::triangleFor). One
/// that is left stands for itself; for another one the nearest to its middle is taken, from the triangles at
/// the vertices that its corners became on to their neighbours while these are nearer, so that it lies on the
/// same sheet; those of the same object and material first. kNone: no vertex of it is left. O(faces +
/// triangles) in practice.
/// @param joinedTo followed
std::vector<std::uint32_t> trianglesFor(const FramedMesh& source, const DecimatedMesh& result,
                                        std::span<const std::uint32_t> joinedTo);

}  // namespace arete
