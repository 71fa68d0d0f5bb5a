// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "engine/follow/cut_difference.h"

namespace arete {

struct IncrementalOptions {
  /// At most this many triangles, spent on the nodes whose saturated error exceeds the allowed one most.
  std::optional<std::uint32_t> maxTriangles{};
  /// The update ends here, between two modifications, and the next update goes on.
  std::optional<Deadline> deadline{};
};

/// The saturated cut for a changing criterion, updated from frame to frame: each update starts from the last
/// cut, applies nodes that became necessary and undoes nodes that are necessary no longer. After every
/// modification it is a cut, so an update that ends early leaves a conforming front.
///
/// A complete update results in the saturated cut from scratch (takeCut()), node for node, also under a
/// budget. It evaluates only nodes whose verdict may have changed since it was computed, if the criterion
/// bounds its motion (KineticCriterion: ViewError is one): a kinetic data structure
/// [BaschGuibasHershberger1997] over the camera's motion. An update without motion costs nothing. Of other
/// criteria it evaluates all nodes that can change. A cut that exceeds its budget is taken from scratch, and
/// the difference is applied.
///
/// Memory: up to 4 bytes per node of the MT, where the cut has been (nodes come coarse ones first), and about
/// 30 per triangle of the front; 24 more per node that can change, in batches of 64 nodes of which up to a
/// few thousand are not full. Not thread-safe; parallel inside.
class IncrementalCut {
 public:
  /// Starts at the root. O(root).
  explicit IncrementalCut(MultiTriangulation mt);
  ~IncrementalCut();
  IncrementalCut(IncrementalCut&&) noexcept;
  IncrementalCut& operator=(IncrementalCut&&) noexcept;

  struct Update {
    std::uint32_t refined = 0, coarsened = 0;  ///< nodes applied, and undone
    /// False when the budget, the deadline or a cancellation ended the update before the criterion was met.
    bool isComplete = true;
  };
  /// Brings the cut to a criterion. O(front) evaluations of the criterion at most and expected O(degree) per
  /// modification; over the budget, O(saturated cut). A cancellation leaves a cut, too.
  /// Errors: usage: as takeCut() for a saturated cut.
  Result<Update> update(const Criterion& criterion, const IncrementalOptions& options = {},
                        const RunContext& context = {});

  /// The modifications of the last update() or apply(), in order.
  std::span<const CutStep> lastSteps() const;
  /// Applies steps, as of difference() or of another cut's updates. Errors: invalidData: at the first step
  /// that does not fit, with its node as the culprit; those before it remain applied.
  Status apply(std::span<const CutStep> steps);

  const MultiTriangulation& mt() const;
  bool contains(NodeId n) const;
  std::uint32_t nodeCount() const;
  /// The MT triangles of the front. A triangle keeps its index until it leaves, or moves to the index of one
  /// that left.
  std::span<const std::uint32_t> triangles() const;

  NodeSet nodes() const;
  Cut front() const;

  /// Checks that the set is closed, that the front is the set's and that all counts agree. Errors:
  /// brokenPromise. O(nodes of the MT).
  Status validate() const;

 private:
  class State;
  class KineticUpdate;
  class Replacement;

  std::unique_ptr<State> state_;
};

}  // namespace arete
