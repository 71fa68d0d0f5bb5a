// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "engine/base/vec.h"
#include "terrain/model/georeference.h"

namespace arete {

/// How long units of a map are on the ground, place by place: on a geographic CRS by geodesics at the
/// latitude of the place, on a projected one by the scale of the map there. Interpolated in a table. Without
/// a CRS a unit is 1.
class GroundScale {
 public:
  /// @param box  of the places, in source coordinates
  GroundScale(const Georeference& georeference, const Box2& box);

  /// Metres along x and along y of one unit of x and one of y. O(1).
  Vec2 at(Vec2 xy) const;

 private:
  Vec2 node(int i, int j) const { return nodes_[std::size_t(j) * std::size_t(columns_) + std::size_t(i)]; }

  Box2 box_;
  int columns_ = 1, rows_ = 1;
  std::vector<Vec2> nodes_;
};

}  // namespace arete
