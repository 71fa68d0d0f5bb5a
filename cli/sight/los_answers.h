// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "cli/session/session.h"
#include "cli/sight/rows.h"
#include "io/geo/table/sight_pairs.h"
#include "io/store/amt/file.h"
#include "terrain/sight/paths.h"

namespace arete {

/// Lines of sight, and how they are answered.
struct LosQuestion {
  const SightPairs& pairs;
  std::array<std::string, 2> typed;  ///< what states each end, where that is an option
  const SightPathOptions& options;
  const SightEarth& earth;
  SightMethod method;        ///< as it is asked for
  const std::string& model;  ///< names the model in errors
};

/// The lines as paths, and the answers to these.
struct LosAnswers {
  SightRows rows;
  /// How far each path's ends lie below the ground; 0 or less: not below.
  std::vector<std::array<double, 2>> buried;
  std::vector<Result<SightPathAnswer>> answers;
  SightMethod method = SightMethod::automatic;  ///< that answered
};

/// Answers lines over a model of which enough is read. Errors: usage: a method that the model does not allow;
/// those of answerPaths().
Result<LosAnswers> answerLines(const LosQuestion& question, const TerrainModel& model,
                               const RunContext& context);

/// Answers lines over the parts of a file that they need. Within a memory budget that all of them together
/// exceed they are answered in batches, by descents where the method is left open: the answers are the same
/// but for the last of twelve digits. Errors: also those of AmtFile::read().
///
/// @param outline of the file
Result<LosAnswers> answerLines(const LosQuestion& question, const AmtFile& file, const TerrainModel& outline,
                               const Session& session);

/// A height below the ground is an answer, blocked, and seldom meant.
///
/// @param unit of heights
void warnOfBuriedEnds(const LosAnswers& answers, const std::string& unit, const Session& session);

}  // namespace arete
