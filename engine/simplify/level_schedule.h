// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "engine/simplify/threshold_list.h"

namespace arete {

/// The thresholds of the levels of a simplification. A level admits the removals whose cost is at most its
/// threshold, and the threshold grows from level to level: cheap removals come first everywhere, which keeps
/// the cuts at any error small (without thresholds the same bound takes 1.9 times as many triangles).
///
/// The growth falls with the number of vertices that are left. Most of the time goes into the first levels,
/// which only the finest cuts depend on; levels among few vertices take almost none, and all coarser cuts
/// depend on their order (docs/decisions/0016 to 0018).
class LevelSchedule {
 public:
  struct Options {
    double first = 0;    ///< threshold of the first level. >= 0
    double ratio = 1.1;  ///< of a threshold and the one before, while all vertices are left. > 1
    /// Where costs are known late: a step by more than this factor waits until the costs are up to date
    /// (Step::refresh). > 1; infinity: no step waits.
    double gap = std::numeric_limits<double>::infinity();
  };
  /// What follows a level.
  enum class Step {
    level,    ///< the next one
    refresh,  ///< the caller makes the vertices due whose cost may have fallen, then the next level
    end,      ///< none: no level removes another vertex
  };

  /// @param vertices that may be removed; it must outlive the schedule.
  LevelSchedule(const ThresholdList& vertices, const Options& options);

  /// The number of vertices that could be removed when the schedule began; 1 if there was none.
  std::size_t sizeAtStart() const { return sizeAtStart_; }
  /// Of the next level, or of the first one of the next pass. Finite as a float, so that a vertex that cannot
  /// be removed (ThresholdList::kNever) is never due.
  double threshold() const { return threshold_; }
  /// The thresholds of a pass of several levels, which begins with threshold() and ends before it has grown
  /// by a factor or after 16 levels; it has at least one level. Last comes the threshold after the pass, for
  /// advanceTo().
  std::vector<double> pass(double span) const;

  /// Moves on after a level. O(1), or O(vertices) if the level removed none.
  Step advance() { return advanceTo(threshold_ * ratio()); }
  /// Moves on after a pass. The threshold is then `next`, or higher: levels at which too few vertices would
  /// be due are skipped.
  Step advanceTo(double next);

 private:
  /// The growth from a level to the next.
  double ratio() const;

  const ThresholdList& vertices_;
  Options options_;
  std::size_t sizeAtStart_, sizeBefore_;  // before: when the last step was made
  double threshold_;
  bool hasChanged_ = false;  // a vertex was removed since the last refresh
};

}  // namespace arete
