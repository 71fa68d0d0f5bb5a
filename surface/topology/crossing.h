// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "engine/base/vec.h"

namespace arete {

/// A triangle by the numbers of its vertices and their places.
struct PlacedTriangle {
  std::array<std::uint32_t, 3> vertices{};
  std::array<Vec3, 3> places{};
};

/// Whether two triangles cross or touch other than at the vertices and the side that they share, decided
/// exactly.
///
///   none    the triangles, as closed sets, must not meet
///   one     the side opposite the shared vertex, of either triangle, must not meet the other triangle
///   two     the two apexes must not lie in one plane with the edge and on the same side of it
///   three   they are one triangle twice: always
///
/// With one shared vertex this is complete: two triangles that meet in a point besides the shared one meet in
/// a segment that starts there, and that segment ends on one of the two opposite sides. Precondition: neither
/// is degenerate.
bool cross(PlacedTriangle s, PlacedTriangle t);

}  // namespace arete
