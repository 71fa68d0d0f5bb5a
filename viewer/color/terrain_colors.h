// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <utility>

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

/// Colours that many looks share; null by default.
class SharedColors : public std::shared_ptr<const TerrainColors> {
 public:
  SharedColors() noexcept = default;
  // NOLINTNEXTLINE(google-explicit-constructor)
  SharedColors(std::shared_ptr<const TerrainColors> colors) noexcept : shared_ptr(std::move(colors)) {}
  SharedColors(const SharedColors&) = default;
  SharedColors(SharedColors&&) noexcept = default;
  SharedColors& operator=(const SharedColors&) = default;
  SharedColors& operator=(SharedColors&&) noexcept = default;
  /// Not in this header: where GCC 12 sees through it, it warns of an unset pointer that is never read.
  ~SharedColors();
};

}  // namespace arete
