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

  /// @param typed what states the first end and the second, for errors; empty: the rows of a file.
  static SightRows of(const SightPairs& pairs, const GroundHeights& heights,
                      const std::array<std::string, 2>& typed = {});
  std::size_t count() const { return rows.size(); }
};

/// How far a height at a place lies below the terrain at full resolution, beyond rounding; 0 or less: not
/// below; NaN without terrain. O(log n).
double depthBelowGround(Vec2 plan, double height, const GroundHeights& heights);

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
  /// Of a scene, by path: what is first in the way, or nothing. Empty: there is terrain alone.
  std::span<const std::string> blockedBy = {};

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
