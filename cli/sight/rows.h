// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/session/session.h"
#include "io/geo/crs/transform.h"
#include "io/geo/table/sight_pairs.h"
#include "terrain/sight/paths.h"

namespace arete {

/// The paths that rows of a file state; a row without one has the reason.
struct SightRows {
  std::vector<SightPath> paths;
  struct Row {
    std::size_t path = 0;  ///< meaningless with an error
    std::optional<Error> error;
  };
  std::vector<Row> rows;

  static SightRows of(const SightPairs& pairs, const GroundHeights& heights);
  std::size_t count() const { return rows.size(); }
};

/// The algorithm that is asked for, or methodFor() the lines.
SightMethod bestMethod(SightMethod asked, double maxError, std::size_t lines, const TerrainModel& model);

struct SightCounts {
  std::size_t visible = 0, blocked = 0, unknown = 0, undecided = 0, failed = 0;
  std::string text() const;
};

/// Answers to rows, as text, JSON and the columns of a table.
struct SightResults {
  const SightPairs& pairs;
  const SightRows& rows;
  std::span<const Result<SightPathAnswer>> answers;  ///< one per path
  const TerrainModel& model;
  bool hasFresnel = false, hasTolerance = false;
  double fresnel = kUsualFresnel;

  /// Null where the row has an answer.
  const Error* errorOf(std::size_t row) const;
  SightCounts counts() const;
  std::string textOf(std::size_t row) const;
  Json jsonOf(std::size_t row) const;
  PointAttributes columns() const;
  std::vector<std::array<Vec2, 2>> ends() const;

 private:
  const SightPathAnswer& answerOf(std::size_t row) const { return *answers[rows.rows[row].path]; }
  bool isFresnelClear(const SightPathAnswer& answer) const {
    return answer.fresnel && answer.sight.verdict == SightVerdict::visible &&
           answer.fresnel->fraction >= fresnel;
  }
};

}  // namespace arete
