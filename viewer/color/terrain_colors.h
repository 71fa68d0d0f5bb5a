// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "viewer/color/color_tables.h"

namespace arete {

/// What the ground is coloured by, whichever of it is shown: the painter, pictures and legends read the same.
struct TerrainColors {
  ColorMap heights = colorTable("height");  ///< in the unit of heights
  ColorMap slopes = colorTable("slope");    ///< degrees
  ColorMap aspects = colorTable("aspect");  ///< degrees clockwise from north
  ColorMap errors = colorTable("error");    ///< 0 to 1, the largest that is shown

  /// The table's, with heights from the lowest to the highest.
  static TerrainColors over(double lowest, double highest) {
    TerrainColors colors;
    colors.heights = heightColors(lowest, highest);
    return colors;
  }
  bool operator==(const TerrainColors&) const = default;
};

}  // namespace arete
