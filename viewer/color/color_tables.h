// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "viewer/color/color_map.h"

namespace arete {

enum class ColorTableKind {
  sequential,  ///< CIELAB lightness grows or falls from end to end
  diverging,   ///< lightest in the middle, equally dark at both ends
  cyclic,      ///< one lightness, the last colour is the first
};

/// A colour map that Arete brings along.
struct ColorTable {
  std::string_view name;
  ColorTableKind kind;
  std::string_view meaning;  ///< a sentence for help
  ColorMap map;
};

/// The one table of colour maps, for shaders, pictures and legends:
///
/// | name | values | |
/// |---|---|---|
/// | height | 0 to 1 | mauve brown, ochre, straw; neither green (no forest) nor white (no snow) nor blue |
/// | depth | 0 (deepest) to 1 (shore) | blues |
/// | slope | 0 to 60 degrees | cream to dark plum: steep is dark |
/// | aspect | 0 to 360 degrees clockwise from north | hues of one lightness; north blue, south ochre |
/// | error | 0 to 1 | dark violet, red, pale yellow: hot is light |
/// | difference | -1 to 1 | blue, near-white at 0, brown |
/// | grey | 0 to 1 | dark to light |
///
/// All channels of a sequential table (and of each half of a diverging one) grow or fall together, so
/// lightness is monotone however finely the table is sampled and rounded.
std::span<const ColorTable> colorTables();

/// A map of the table. Precondition: the name is in it.
const ColorMap& colorTable(std::string_view name);
/// Null if the name is not in the table.
const ColorTable* findColorTable(std::string_view name);

/// The grey with the lightness of "aspect", where ground has no aspect.
inline constexpr Rgb kNoAspectColor = {166, 166, 166};

/// Heights from `low` to `high` as "height". With a sea level, what lies at or below it has the colours of
/// "depth" down to `low` (at least one unit below the level), and the land's begin above it. Where nothing
/// lies below the level, all water has the colour of the shore. Precondition: finite, low <= high.
ColorMap heightColors(double low, double high, std::optional<double> seaLevel = {});

/// A map with its own colours above a sea level and the colours of "depth" at and below it, down to `low`.
/// Precondition: the map is linear.
ColorMap withSea(const ColorMap& land, double seaLevel, double low);

/// Colours for classes that we draw ourselves: at least 10 apart by CIEDE2000, also as people without one
/// kind of cones see them (Machado 2009).
std::span<const Rgb> classColors();

}  // namespace arete
