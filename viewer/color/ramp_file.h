// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "viewer/color/color_map.h"

namespace arete {

/// A colour map that a person wrote or another program exported, as text.
struct RampFile {
  struct Line {
    double value = 0;  ///< in the data's unit, or per cent of its range
    bool isPercent = false;
    Rgba color;
    std::string label;
    std::size_t line = 0;  ///< in the file, from 1
  };
  std::string source;       ///< the file's name, the culprit of errors
  std::vector<Line> lines;  ///< at least one, as the file has them
  std::optional<Rgba> nodata, outside;
  /// By the file ("INTERPOLATION:DISCRETE"); linear if it says nothing.
  ColorsBetween between = ColorsBetween::linear;

  bool usesPercent() const;

  /// The map over data between two heights, which only per cent refer to. Colours are taken as they are: a
  /// word is said where neighbours are hardly distinct, and where two colours of one value make a step.
  ///
  /// @param between Replaces what the file says.
  /// @param warnings Sentences about the file, which they do not name.
  /// Errors: invalidData: two colours for one value, where colours are not linear. Precondition: low <= high.
  Result<ColorMap> map(double low, double high, std::optional<ColorsBetween> between,
                       Warnings& warnings) const;
};

/// Reads colour maps of
/// - gdaldem color-relief and GRASS r.colors: a value, `50%`, `nv` (NODATA) or `default` (what no line
///   reaches), then a name, `red green blue` or `red green blue opacity` of 0 to 255, between spaces, tabs,
///   commas or colons; `#` begins a comment;
/// - QGIS ("QGIS Generated Color Map Export File"): value,red,green,blue,opacity,label, where the label may
/// hold
///   commas, values may be `inf` or `-inf`, and INTERPOLATION:INTERPOLATED, DISCRETE or EXACT says how.
///
/// Lines may come in any order. Errors: notFound, unreadable; corrupt: a line that is neither, by its number;
/// no colour in the file; unsupported: styles of QGIS (.qml), SLD and palettes of GMT (.cpt), which are other
/// formats. O(size).
Result<RampFile> readRampFile(const std::string& path);

/// The same of a text. @param source names it in errors.
Result<RampFile> parseRamp(std::string_view text, const std::string& source);

}  // namespace arete
