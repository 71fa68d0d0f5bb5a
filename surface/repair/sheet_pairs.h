// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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

/// Pairs the triangles around an edge into sheets that bound the same solid: each triangle has solid behind
/// it, by its turn, and its partner is the triangle that bounds that solid on the other side. Some may have
/// no partner. Angles are compared exactly: triangles in one plane are at equal angles. O(n log n).
/// @return the pairs, in no order.
std::vector<std::pair<CornerId, CornerId>> pairSheets(const Vec3& from, const Vec3& to,
                                                      std::span<const SheetSide> sides);

}  // namespace arete::repair_passes
