// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <limits>

#include "terrain/sight/answer.h"
#include "terrain/sight/line.h"

namespace arete {

/// Computes the answer for one line from the terrain that an engine reports below it, from the first end to
/// the last. The rules of docs/topics/visibility.md are implemented here alone, so all engines share them.
class SightJudge {
 public:
  /// Precondition: the line outlives it.
  SightJudge(const SightLine& line, const SightOptions& options);

  const SightLine& line() const { return line_; }

  /// @param mayHaveGaps part of the stretch may be without terrain.
  /// @return false if terrain that is nowhere above the straight line from (s0, top0) to (s1, top1) cannot
  ///     change the answer: the engine may continue at s1.
  bool matters(double s0, double top0, double s1, double top1, bool mayHaveGaps) const {
    return (mayHaveGaps && countsGaps_) || line_.leastBound(s0, top0, s1, top1) < limit_;
  }
  /// Reports terrain of full resolution between s0 and s1, straight from z0 to z1.
  void terrain(double s0, double z0, double s1, double z1) {
    if (line_.leastBound(s0, z0, s1, z1) < limit_) take(s0, z0, s1, z1, 0, 0);
  }
  /// Reports terrain that is known to be within [-lower, higher] of that straight line (a tolerance).
  void terrain(double s0, double z0, double s1, double z1, double lower, double higher) {
    if (line_.leastBound(s0, z0 + higher, s1, z1 + higher) < limit_) take(s0, z0, s1, z1, lower, higher);
  }
  /// Reports that there is no terrain between s0 and s1, which may be equal.
  void gap(double s0, double s1);
  /// Gives a bound out of order: the terrain is at least z high at s, so matters() can rule out more.
  void hint(double s, double z);
  /// @return false if the terrain of a hint was not reported: it is a single point, which engines may pass
  ///     over. Then too much was ruled out, and the line has to be evaluated again without hints.
  bool areHintsKept() const { return !(most_ > hint_ + line_.tolerance()); }

  /// @return whether nothing that follows can change the answer.
  bool isDone() const { return isDone_; }

  /// @param visited SightAnswer::visited.
  SightAnswer answer(std::uint64_t visited) const;

 private:
  void take(double s0, double z0, double s1, double z1, double lower, double higher);
  void setLimit();

  const SightLine& line_;
  const SightOptions options_;
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  double limit_;  ///< terrain with at least this clearance changes nothing
  /// The least clearance of the terrain reported so far is in [least_, most_].
  double least_ = kNone, most_ = kNone, hint_ = kNone;
  double leastAt_ = 0, leastTerrain_ = 0;
  double gap_ = 0;
  bool countsGaps_, hasGap_ = false, isDone_ = false, mayBeBlocked_ = false;
  bool isObstructionLatest_ = false;
  std::optional<SightPlace> obstruction_;
};

}  // namespace arete
