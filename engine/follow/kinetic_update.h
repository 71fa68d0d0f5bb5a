// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/follow/incremental_state.h"

namespace arete {

/// Brings a saturated cut to a criterion by asking only about the nodes that can change and whose verdict may
/// have turned since it was given (Criterion::exceedingFor). Where the criterion cannot say how far it has
/// moved, it asks about all that can change.
class IncrementalCut::KineticUpdate {
 public:
  KineticUpdate(State& state, const Criterion& criterion, const IncrementalOptions& options,
                const RunContext& context)
      : s_(state), criterion_(criterion), o_(options), context_(context) {}

  enum class End {
    complete,
    stopped,     ///< by the deadline or an interruption; the next update goes on
    overBudget,  ///< the cut asked for has more triangles than there may be
  };
  /// Appends to the state's steps.
  End run();

 private:
  struct Answers;
  /// A watched node that does not stay as it is, how long that is so, how much it matters, and what was asked
  /// about: by now its ball and error are here, in the MT they are far away.
  struct Change {
    std::uint32_t node;
    float units;
    double ratio;
    Sphere ball;
    float error;
    bool operator<(const Change& other) const {
      return ratio != other.ratio ? ratio < other.ratio : node > other.node;
    }
  };

  bool mustStop();
  void begin();
  void search();
  void askUnasked();
  void askDue();
  void settle(const KineticQueue::Block& block, const Answers& answers);
  void keep(const Change& change);
  void prefetchNext(const std::vector<Change>& changes) const;
  void coarsen(double millisecondsToLeave);
  void leave(const Change& change);
  void refine();
  void enter(const Change& change);

  State& s_;
  const Criterion& criterion_;
  const IncrementalOptions& o_;
  const RunContext& context_;
  bool hasStopped_ = false, isSearchCut_ = false, isOverBudget_ = false;
  std::vector<Change> leaving_, entering_;  // entering: under a deadline a heap, the largest ratio on top
};

}  // namespace arete
