// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/base/vec.h"

namespace arete {

/// The class of a vertex by its triangles and creases [SchroederZargeLorensen1992], with the names of Mirza,
/// Skvortsov, Sobolev, "Multitriangulation" (Tomsk State University), section 1.
enum class VertexClass : std::uint8_t {
  isolated,      ///< in no triangle
  simple,        ///< a full cycle of triangles, no crease
  boundary,      ///< an open cycle of triangles, creases or none
  interiorEdge,  ///< a full cycle with exactly two creases: a ridge or a valley line runs through
  corner,        ///< a full cycle with one crease, or three and more; or an edge of more than two triangles
};

/// Position of a vertex by its index, all three coordinates in one unit.
using PositionOf = std::function<Vec3(std::uint32_t vertex)>;

/// Classifies every vertex of a triangulation. A *crease* is an edge whose two triangles' normals differ by
/// more than `creaseAngleDegrees` (0..180), as isCrease() has it (engine/base/crease.h). Positions must be
/// metric: the same unit in plan and height, or the angle means nothing. A triangle without area has no
/// normal and makes no crease. Precondition: every index < `vertexCount` (= positions.size()), triangles
/// coherently oriented, finite positions. O(n) time for bounded vertex degrees, about 80 bytes per vertex of
/// a raster while it runs.
std::vector<VertexClass> classifyVertices(std::span<const Vec3> positions,
                                          std::span<const std::array<std::uint32_t, 3>> triangles,
                                          double creaseAngleDegrees);
std::vector<VertexClass> classifyVertices(std::size_t vertexCount, const PositionOf& positionOf,
                                          std::span<const std::array<std::uint32_t, 3>> triangles,
                                          double creaseAngleDegrees);

}  // namespace arete
