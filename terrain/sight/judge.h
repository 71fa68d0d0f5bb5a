// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <limits>

#include "terrain/sight/answer.h"
#include "terrain/sight/line.h"

namespace arete {

/// Gathers the answer for one line from what an engine finds below it, piece by piece from the first end to
/// the last. The rules of docs/topics/visibility.md are here and nowhere else.
class SightJudge {
 public:
  SightJudge(const SightLine& line, const SightOptions& options);

  const SightLine& line() const { return line_; }

  /// False when terrain that is nowhere above the straight line from (s0, top0) to (s1, top1) changes
  /// nothing: the engine may go on at s1. `mayHaveGaps`: part of it may be no terrain at all.
  bool matters(double s0, double top0, double s1, double top1, bool mayHaveGaps) const {
    return (mayHaveGaps && countsGaps_) || line_.leastBound(s0, top0, s1, top1) < limit_;
  }
  /// The terrain of full resolution between s0 and s1, straight from z0 to z1.
  void terrain(double s0, double z0, double s1, double z1) {
    if (line_.leastBound(s0, z0, s1, z1) < limit_) take(s0, z0, s1, z1, 0, 0);
  }
  /// The same, of what is known only to be within [-lower, higher] of that straight line: for engines that
  /// stop at a tolerance.
  void terrain(double s0, double z0, double s1, double z1, double lower, double higher) {
    if (line_.leastBound(s0, z0 + higher, s1, z1 + higher) < limit_) take(s0, z0, s1, z1, lower, higher);
  }
  /// No terrain between s0 and s1, which may be one place.
  void gap(double s0, double s1);
  /// Out of order: the terrain is at least this high at s. More can then be passed over.
  void hint(double s, double z);
  /// False when the terrain of a hint was not among what was told: it was in a single point, which engines
  /// may pass. Then too much was passed over: ask again without hints.
  bool areHintsKept() const { return !(most_ > hint_ + line_.tolerance()); }

  /// Nothing that follows can change the answer.
  bool isDone() const { return isDone_; }

  SightAnswer answer(std::uint64_t visited) const;

 private:
  void take(double s0, double z0, double s1, double z1, double lower, double higher);
  void setLimit();

  const SightLine& line_;
  const SightOptions options_;
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  double limit_;  ///< terrain that leaves this much below the line changes nothing
  /// Of the terrain seen so far: the least clearance is in [least_, most_].
  double least_ = kNone, most_ = kNone, hint_ = kNone;
  double leastAt_ = 0, leastTerrain_ = 0;
  double gap_ = 0;
  bool countsGaps_, hasGap_ = false, isDone_ = false, mayBeBlocked_ = false;
  bool isObstructionLatest_ = false;
  std::optional<SightPlace> obstruction_;
};

}  // namespace arete
