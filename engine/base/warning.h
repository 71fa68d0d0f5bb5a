// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arete {

/// What a warning is about. Programs tell warnings apart by its name (nameOf), which stays; sentences may
/// change.
enum class WarningCode {
  position,   ///< where the data lies: no georeference, no CRS, a CRS replaced or assumed
  unit,       ///< the unit or the direction of heights
  heights,    ///< heights that may not be heights: NODATA, infinite or far away, in doubt between files
  choice,     ///< what was taken where the input leaves a choice: a band, a column, a resolution
  omitted,    ///< data of the input, or of the model, that the output does not have
  completed,  ///< data that the input lacks or contradicts, and what stands for it
  geometry,   ///< polygons and surfaces that are open, cross themselves or cannot be united
  damaged,    ///< files that may have been cut short
  bound,      ///< a tolerance that does not hold everywhere
  library,    ///< what GDAL says itself
  display,    ///< how the viewer draws, or what it cannot draw
};

/// "position", "unit", ...
std::string_view nameOf(WarningCode code);

/// A sentence about something that is not as its user may believe, though the work goes on.
struct Warning {
  WarningCode code;
  std::string sentence;

  bool operator==(const Warning&) const = default;
  /// A warning reads as its sentence.
  operator const std::string&() const { return sentence; }  // NOLINT(google-explicit-constructor)

  /// The same behind "prefix".
  Warning behind(std::string_view prefix) const { return {code, std::string(prefix) + sentence}; }
};

using Warnings = std::vector<Warning>;

}  // namespace arete
