// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "cli/sight/arguments.h"
#include "engine/base/result.h"
#include "io/files/existing_file.h"
#include "terrain/viewshed/viewshed.h"

namespace arete {

// The options of `arete viewshed`, one struct for each group of its help.

/// What a cell of the answer holds.
enum class ViewshedMode {
  seen,     ///< whether it is seen
  height,   ///< the least height above the terrain that is seen
  horizon,  ///< the elevation of the horizon in degrees
  count,    ///< how many observers see it
  server,   ///< the nearest observer that sees it
};

/// As it is typed.
std::string_view toString(ViewshedMode mode);

/// Where the observers are.
struct ObserverArguments {
  std::vector<std::string> typed;  ///< "X,Y,H" each
  std::string file, layer;         ///< a table or layer of points; empty = none
  std::string usualHeight;         ///< of rows without a height; empty = none

  /// Options of --observer, --observers and what belongs to the latter.
  void addTo(CLI::App& command);
};

/// The field of view of all observers, but for what a row of the file states itself.
struct FieldOfViewArguments {
  double greatestMetres = std::numeric_limits<double>::infinity(), leastMetres = 0;
  std::string azimuths, elevations;             ///< "A,B" in degrees; empty = all
  std::string greatestWithUnit, leastWithUnit;  ///< as checkGroundUnits() takes them

  void addTo(CLI::App& command);
  /// Errors: usage, naming the option.
  Result<ViewshedField> field() const;
};

struct ViewshedArguments {
  std::string model, output, polygons, png, like;
  bool isPlainPicture = false;  ///< without legend, scale bar, north arrow and graticule
  ExistingFile existing = ExistingFile::keepsOtherLayers;
  ObserverArguments observers;
  FieldOfViewArguments fieldOfView;
  SightArguments sight;
  ViewshedMode mode = ViewshedMode::seen;
  ViewshedMethod method = ViewshedMethod::automatic;
  std::string targetHeight = "0";  ///< as it is stated
  std::string maxError = "0";      ///< as it is stated

  void addTo(CLI::App& command);
  /// The rules between options that CLI11 cannot state. Errors: usage, naming the option.
  Status check() const;
  /// Errors: usage, naming the option.
  Result<ViewshedOptions> options() const;
  /// Whether the answer is that of one observer; else cells combine several.
  bool isOfOne(std::size_t observerCount) const;
};

}  // namespace arete
