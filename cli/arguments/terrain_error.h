// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "cli/arguments/arguments.h"
#include "cli/session/session.h"
#include "engine/base/result.h"
#include "io/store/amt/file.h"

namespace arete {

/// An error of terrain as the option --max-error states it: "2", or "0.5%" of the relief.
struct TerrainError {
  double value = 0;                ///< in the unit of the heights
  std::optional<double> relief{};  ///< of the terrain, where the error is stated as a share of it

  /// "2 m", and "2 m (0.5 % of the relief)" where it was stated as a share.
  std::string text(const std::string& unit) const;
  /// "; within " and the text where it was stated as a share; otherwise empty.
  std::string shareText(const std::string& unit) const;
  /// Adds "maxError", and "maxErrorPercent" and "relief" where it was stated as a share.
  void addTo(Json& json) const;
};

/// Adds --max-error.
///
/// @param help what the error is of, without its unit.
/// @param mayBeInfinite whether "inf" is an answerable error.
void addTerrainErrorTo(CLI::App& command, std::string& text, const std::string& help, bool mayBeInfinite);

/// Whether the option states an error above 0.
bool isAboveZero(const std::string& text);

/// The error that the option states. For a share of the relief all of the file is read.
///
/// Errors: usage, naming --max-error; those of AmtFile::read().
Result<TerrainError> terrainErrorOf(const std::string& text, const AmtFile& file, const Session& session);

}  // namespace arete
