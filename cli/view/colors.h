// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "cli/arguments/option_kinds.h"
#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "terrain/model/terrain_model.h"
#include "viewer/color/ramp_file.h"
#include "viewer/color/terrain_colors.h"

namespace arete {

/// Which colours heights, slopes and aspects have.
struct ColorArguments {
  std::string ramp;   ///< a name of the table or a file; empty: by what is coloured
  std::string mode;   ///< empty: as the file says, else linear
  std::string range;  ///< "LOW,HIGH"; empty: of the data
  double seaLevel = 0;
  const CLI::Option* seaOption = nullptr;

  void addTo(CLI::App& command, const std::string& group, OptionKinds& kinds);
  bool isStated() const;

  /// A word where much of a terrain is at exactly 0 and has the colours of land; empty: none is needed.
  std::string wordOfSea(const std::string& coloring, const TerrainModel& model) const;

  /// The colours of a terrain.
  ///
  /// @param coloring what is coloured: "height", "slope", "aspect"; empty: height.
  /// Errors: usage: options that do not go together or with `coloring`, or that say nothing; the errors of
  /// readRampFile() and RampFile::map().
  Result<TerrainColors> of(const std::string& coloring, const TerrainModel& model, Warnings& warnings) const;
};

}  // namespace arete
