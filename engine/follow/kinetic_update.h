// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/follow/incremental_state.h"

namespace arete {

/// Updates a saturated cut by evaluating only the nodes that can change and whose certificates have failed
/// (KineticQueue). If the criterion cannot bound its motion, all certificates have.
class IncrementalCut::KineticUpdate {
 public:
  KineticUpdate(State& state, const BoundedCriterion& criterion, const IncrementalOptions& options,
                const RunContext& context)
      : s_(state), criterion_(criterion), o_(options), context_(context) {}

  enum class End {
    complete,
    stopped,     ///< by the deadline or a cancellation; the next update goes on
    overBudget,  ///< the criterion's cut has more triangles than the budget
  };
  /// Appends to the state's steps. Over the budget the cut is one between the last and the criterion's.
  End run();

 private:
  struct Verdicts;
  /// A node to apply or to undo, how long its verdict holds, its priority under a deadline, and its ball and
  /// error, which are in a cache here and not in the MT.
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
  void evaluatePending();
  void evaluateDue();
  void settle(const KineticQueue::Batch& batch, const Verdicts& verdicts);
  void addCertificate(const Change& change);
  void prefetchNext(const std::vector<Change>& changes) const;
  void coarsen(double millisecondsToLeave);
  void leave(const Change& change);
  void refine();
  void enter(const Change& change);

  State& s_;
  const BoundedCriterion& criterion_;
  const IncrementalOptions& o_;
  const RunContext& context_;
  bool hasStopped_ = false, isSearchCutShort_ = false, isOverBudget_ = false;
  std::vector<Change> leaving_, entering_;  // entering: under a deadline a heap, the largest ratio on top
};

}  // namespace arete
