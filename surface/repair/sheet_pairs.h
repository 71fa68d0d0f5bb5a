// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/vec.h"
#include "surface/topology/edges.h"

namespace arete::repair_passes {

/// A side of a triangle on an edge that several triangles share.
struct SheetSide {
  CornerId side;
  Vec3 apex;       ///< the triangle's corner opposite the edge
  bool isForward;  ///< the side runs from `from` to `to`
};

/// Which triangles around an edge are partners.
enum class SheetPairing : std::uint8_t {
  solids,  ///< the two that bound a solid: each triangle has solid behind it, by its turn
  twins,   ///< the two sides of a sheet, where they lie in one place, and then as solids
  spaces   ///< the two that bound what is between solids
};

/// Pairs the triangles around an edge into sheets. Some may have no partner. Angles are compared exactly:
/// triangles in one plane are at equal angles. O(n log n).
/// @return the pairs, in no order.
std::vector<std::pair<CornerId, CornerId>> pairSheets(const Vec3& from, const Vec3& to,
                                                      std::span<const SheetSide> sides,
                                                      SheetPairing pairing = SheetPairing::solids);

}  // namespace arete::repair_passes
