// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/vec.h"
#include "viewer/color/color_map.h"
#include "viewer/picture/picture.h"
#include "viewer/scene/layer.h"

namespace arete {

/// A class of a legend: a box of the colours that it has in the picture, from shadow to light where it is
/// shaded, and what it means.
struct LegendClass {
  std::vector<Rgb> colors;
  std::string label;
  Legend::Mark mark = Legend::Mark::area;  ///< what is drawn in place of a box
};

/// The colours of a range of values, with numbers.
struct LegendScale {
  ColorMap map;
  double low = 0, high = 1;
  /// Numbers other than the round ones, with their texts; "N" at 0 of an aspect, say.
  std::vector<std::pair<double, std::string>> ticks = {};
  /// The colours that one colour has in the picture, from shadow (0) to light (1), where it is shaded: the
  /// scale shows them side by side. Empty: none but itself.
  std::function<Rgb(Rgb, double)> shade = {};
};

/// What the colours of a picture, or of one of its layers, mean.
struct ColorLegend {
  std::string title;
  std::string unit = {};
  std::optional<LegendScale> scale = {};
  std::vector<LegendClass> classes = {};  ///< below the scale
};

/// The legend of a map of colours: a scale of its finite values where they are mixed, a class for each of its
/// colours where they are not. A range replaces the ends of the scale.
ColorLegend legendOf(const ColorMap& map, std::string title, std::string unit = {},
                     std::optional<std::pair<double, double>> range = {});

struct LegendStyle {
  double textSize = 13;    ///< pixels
  double barHeight = 150;  ///< of a scale
  double maxHeight = 1e9;  ///< classes that do not fit are counted in a last line
};

/// The room that legends need, one below the other, with their margins.
Vec2 legendSize(std::span<const ColorLegend> legends, const LegendStyle& style = {});

/// Where the scale of a legend was drawn: its topmost row of pixels has the colour of the highest value, the
/// lowest row the colour of the lowest one.
struct DrawnScale {
  Rect bar;
  double low = 0, high = 1;
};

/// Draws legends with the left top corner at `corner`. Colours are exactly the map's. O(pixels drawn).
/// @return the scales, in the order of the legends that have one.
std::vector<DrawnScale> drawLegends(Canvas& canvas, std::span<const ColorLegend> legends, Vec2 corner,
                                    const LegendStyle& style = {});

}  // namespace arete
