// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "engine/follow/cut_difference.h"

namespace arete {

struct IncrementalOptions {
  CutMethod method = CutMethod::minimal;
  std::optional<std::uint32_t> maxTriangles{};
  std::optional<Deadline> deadline{};
  /// What is refined first where not all can be. Worst first when null.
  std::shared_ptr<const RefineOrder> order{};
  /// Minimal, without a budget, time permitting: undo also what no leaf alone gives away, so that the result
  /// is the least cut, as from scratch. Costs a walk of the whole cut; without a deadline that walk is all
  /// there is.
  bool exact = true;
};

/// A cut that follows a changing criterion: each update starts from the last cut, refines what is no longer
/// fine enough and coarsens what is finer than needed. Between any two modifications it is a cut; stopped
/// early, it is simply not yet all it was asked for, and the next update goes on.
///
/// A saturated update is equal to the saturated cut from scratch; a minimal one to the minimal cut, when it
/// is exact. Without `exact` a minimal update may keep a little more, because errors are not monotone down
/// the graph: a node whose floor fails the criterion stays, though a coarser triangle would do.
///
/// A saturated update asks only about the nodes whose verdict may have turned since they were asked about,
/// where the criterion knows how far it has moved (Criterion::motionSince(): ViewError does); a camera that
/// rests costs nothing.
///
/// Holds 4 bytes per node of the MT, and some 30 per triangle of the front; saturated, 24 more per node that
/// can change, in blocks of 64 nodes of which up to a few thousand are not full. Not thread-safe; works in
/// parallel inside.
class IncrementalCut {
 public:
  /// Starts at the root. O(nodes).
  explicit IncrementalCut(MultiTriangulation mt);
  ~IncrementalCut();
  IncrementalCut(IncrementalCut&&) noexcept;
  IncrementalCut& operator=(IncrementalCut&&) noexcept;

  struct Update {
    std::uint32_t refined = 0, coarsened = 0;
    /// False when the budget, the deadline or an interruption ended the update before all was done.
    bool isComplete = true;
  };
  /// Errors: usage, as takeCut() (a deadline and an order suit either method here). O(front) tests of the
  /// criterion at most, and O(log) per modification. An interruption leaves a cut, too.
  Result<Update> update(const Criterion& criterion, const IncrementalOptions& options = {},
                        const RunContext& context = {});

  /// The modifications of the last update or apply(), in their order.
  std::span<const CutStep> lastSteps() const;
  /// Plays modifications, of difference() or of another cut's updates. Errors: invalidData at the first one
  /// that does not fit, naming it; those before it stay.
  Status apply(std::span<const CutStep> steps);

  const MultiTriangulation& mt() const;
  bool contains(NodeId n) const;
  std::uint32_t nodeCount() const;
  /// The MT triangles of the front. A triangle keeps its place until it, or one that fills a gap, goes.
  std::span<const std::uint32_t> triangles() const;

  NodeSet nodes() const;
  Cut front() const;

  /// Closed; the front is the set's; counts agree. Errors: brokenPromise. O(nodes of the MT).
  Status validate() const;

 private:
  class State;
  class Pass;
  class KineticUpdate;
  static bool bring(State& state, const Criterion& criterion, const IncrementalOptions& options,
                    const RunContext& context);

  std::unique_ptr<State> state_;
};

}  // namespace arete
