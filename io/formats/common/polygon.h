// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/vec.h"

namespace arete {

/// A polygon in space as triangles.
struct PolygonTriangles {
  /// Three corners of the polygon each, counted over all rings, in the direction of the outline.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// False: the outline crosses itself from whichever side it is seen, or a hole crosses the outline. The
  /// triangles are then the set of least area that the outline has, or a fan where it has many corners.
  bool isSimple = true;
};

/// From where a polygon is seen, to find its inside.
enum class PolygonView {
  /// From the side of its normal: for surfaces of any shape.
  along,
  /// From above, if it has an area there: for terrain, whose heights may be in another unit than the plan.
  above,
};

/// Triangulates a polygon, convex or not, planar or not, with holes or without. No vertex is added, and no
/// edge is left out, so that neighbours still meet along whole edges.
///
/// The outline may touch itself: a hole may be joined to it by a bridge that it follows there and back
/// (corners at one position are distinguished by the angle in which a triangle lies), and corners may repeat
/// or lie on one line. A polygon of n corners and h holes has n + 2 h - 2 triangles, counting those of no
/// area between corners that repeat; fewer where a part of the outline encloses nothing. A polygon all of
/// whose corners lie on one line is a fan.
///
/// Where the fan about the first corner is right, the triangles are that fan.
///
/// Preconditions: finite corners, fewer than 2^31.
///
/// @param corners Ring by ring, the outline first; the last corner of a ring does not repeat its first.
/// @param view Where the polygon is flat, either is right.
/// @param ringEnds The number of corners up to the end of each ring; empty: one ring. Rings of either
/// direction.
///
/// O(n log n) expected, on a constrained Delaunay triangulation [Chew1989] of the projection.
PolygonTriangles triangulatePolygon(std::span<const Vec3> corners, PolygonView view = PolygonView::along,
                                    std::span<const std::uint32_t> ringEnds = {});

/// True if triangulatePolygon() of a polygon of one ring gives the fan about its first corner. O(corners),
/// without memory. Preconditions: those of triangulatePolygon().
bool hasRightFan(std::span<const Vec3> corners, PolygonView view = PolygonView::along);

}  // namespace arete
