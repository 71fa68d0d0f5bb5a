// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "viewer/color/color_map.h"
#include "viewer/scene/layer.h"

namespace arete {

/// Colours of the triangles of a surface by a number of each, whichever of them are drawn, and what they
/// mean.
struct TriangleInk {
  std::vector<float> numbers;  ///< by triangle of the MT; NaN: it has none
  ColorMap colors;             ///< of the numbers; its `nodata` is of those without
  std::string title;
  std::string unit = {};  ///< of the texts of the scale; empty: none
  /// The numbers of the scale with their texts; empty: there is no scale.
  std::vector<std::pair<double, std::string>> ticks = {};
  std::vector<Legend::Entry> classes = {};  ///< colours by themselves
};

}  // namespace arete
