// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ogr_geometry.h>

#include <string>
#include <vector>

#include "engine/base/vec.h"
#include "engine/base/warning.h"

namespace arete {

using Ring = std::vector<Vec2>;

/// The rings of polygons, holes among them, without the repeated vertices. Rings of fewer than three
/// vertices are left out.
std::vector<Ring> ringsOf(const OGRMultiPolygon& polygons);

/// The polygons that rings bound by the even-odd rule. O(rings^2) at worst.
OGRMultiPolygon polygonsOf(const std::vector<Ring>& rings);

/// Replaces polygons that touch or cross themselves by valid ones that cover all that their rings go around,
/// also what a ring goes around twice. One that cannot be repaired stays, with a warning.
OGRMultiPolygon repaired(const OGRMultiPolygon& polygons, Warnings& warnings);

/// The union of polygons; the polygons themselves, with a warning, where GEOS cannot make it.
OGRMultiPolygon united(const OGRMultiPolygon& polygons, Warnings& warnings);

/// The union of polygons whose x are known up to multiples of `turn`, with x from -turn/2 to turn/2. The
/// polygons themselves where they reach over a turn at most, since then none covers another, or without a
/// turn.
OGRMultiPolygon withinOneTurn(const OGRMultiPolygon& polygons, double turn, Warnings& warnings);

}  // namespace arete
