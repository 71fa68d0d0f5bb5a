// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "engine/base/vec.h"
#include "viewer/decoration/picture_ground.h"
#include "viewer/picture/picture.h"

namespace arete {

/// A bar of round length. It has the scale of the ground at the middle of the picture, across it.
struct ScaleBar {
  double length = 1;  ///< on the ground, in metres, or in source units without a CRS
  double pixels = 1;
  std::string label;  ///< the length with its unit
  /// "at the middle" where the scale differs from place to place, "at the cross" where the middle shows no
  /// ground; else empty. Of a parallel picture also the length of a pixel, before it.
  std::string where;
  std::optional<Vec2> cross;  ///< the pixel whose scale it is, where that is not the middle
};

/// Nothing where the picture shows no ground with a length.
/// @param maxPixels The bar is at most that long, and at least two fifths of it.
std::optional<ScaleBar> scaleBarOf(const PictureGround& ground, double maxPixels);

/// "20 m", "5 km", "2 cm"; without metres the number and the unit.
std::string lengthText(double length, bool isMetres, const std::string& unit);

/// The room that the bar takes with its texts.
Vec2 scaleBarSize(const Canvas& canvas, const ScaleBar& bar, double textSize);
/// @param corner Left top of that room.
void drawScaleBar(Canvas& canvas, const ScaleBar& bar, Vec2 corner, double textSize);

}  // namespace arete
