// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/vec.h"
#include "viewer/decoration/picture_ground.h"
#include "viewer/picture/picture.h"

namespace arete {

struct NorthArrow {
  Vec2 toNorth = {0, -1};  ///< a unit vector of the picture, whose y points down
  /// Lines beside the arrow: "true north" or "grid north"; "at the middle" where it turns over the picture;
  /// by how much the grid of the map is turned from true north.
  std::vector<std::string> words;
};

/// North at the middle of the picture, or at the ground nearest below it. Nothing without a CRS.
std::optional<NorthArrow> northArrowOf(const PictureGround& ground);

Vec2 northArrowSize(const Canvas& canvas, const NorthArrow& arrow, double textSize);
/// @param corner Left top of that room.
void drawNorthArrow(Canvas& canvas, const NorthArrow& arrow, Vec2 corner, double textSize);

}  // namespace arete
