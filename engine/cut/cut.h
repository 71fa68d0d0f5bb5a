// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/result.h"
#include "engine/criteria/criterion.h"
#include "engine/criteria/refine_order.h"
#include "engine/mt/multitriangulation.h"
#include "engine/parallel/deadline.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// A set of nodes, one byte each: 0 = not a member. Closed when the creators of every member's floor are
/// members too.
using NodeSet = std::vector<std::uint8_t>;

/// The front of a cut: a conforming, positively oriented triangulation of the whole domain (law 5).
struct Cut {
  std::vector<std::uint32_t> vertices;  ///< MT vertex of each vertex of the front
  std::vector<std::array<std::uint32_t, 3>>
      triangles;                   ///< indices into `vertices`, counter-clockwise in the plan
  std::vector<std::uint32_t> ids;  ///< MT triangle of each triangle
  double achievedError = 0;        ///< largest error of its triangles, as stored (rounded up)
  std::uint32_t nodes = 0;         ///< nodes in the cut
  /// False when a budget or a deadline ended the refinement before the criterion was met wherever it can be.
  bool isComplete = true;
  /// Of a part of a multitriangulation: triangles of this front that the cut of the whole refines, because
  /// they fail the criterion and the nodes that remove them are not in the part. A caller that finds some
  /// reads what is there and takes the cut anew, or takes this one, which is a front without holes, as it is.
  /// (Under a budget, those that the refinement would have come to before it ended.)
  std::vector<std::uint32_t> missing;  ///< MT triangles, rising
};

/// Two ways to take a cut, both exact (docs/topics/cuts.md).
enum class CutMethod {
  minimal,    ///< the least cut for the criterion, with all its ancestors [DeFlorianiMagilloPuppo1998]
  saturated,  ///< independent tests per node, parallel: a few percent more triangles, no graph walk
};

struct CutOptions {
  CutMethod method = CutMethod::minimal;
  /// At most this many triangles, spent where the criterion's severity is worst; the criterion may stay
  /// unmet.
  std::optional<std::uint32_t> maxTriangles{};
  /// Of a minimal cut: the refinement ends here, between two modifications; the criterion may stay unmet.
  std::optional<Deadline> deadline{};
  /// Of a minimal cut under a budget or a deadline: what is refined first. Null: the worst first.
  std::shared_ptr<const RefineOrder> order{};
};

/// The front of the least (or the saturated) cut whose triangles all satisfy the criterion, or have nothing
/// finer. A budget that is spent worst first leaves the least cut of the severity that it reached: no cut of
/// as many triangles has a smaller one.
///
/// Minimal: O(saturated cut) for a bounded criterion, else O(triangles visited); with a budget or a deadline
/// times log. Saturated: O(N) at most, O(size of the cut) for a uniform error.
/// Errors: usage: as checkCut(), and when a saturated cut has a deadline or an order; interrupted.
Result<Cut> takeCut(const MultiTriangulation& mt, const Criterion& criterion, const CutOptions& options = {},
                    const RunContext& context = {});

/// The nodes of a cut, without its front.
struct NodeCut {
  NodeSet nodes;
  bool isComplete = true;  ///< Cut::isComplete
};
/// takeCut() without the front. Errors: as takeCut().
Result<NodeCut> takeNodes(const MultiTriangulation& mt, const Criterion& criterion,
                          const CutOptions& options = {}, const RunContext& context = {});

/// Checks that a cut can be taken. Errors: usage: the budget is below the root's triangles (field
/// maxTriangles), or the cut is saturated and the criterion is not bounded.
Status checkCut(const MultiTriangulation& mt, const Criterion& criterion, CutMethod method,
                std::optional<std::uint32_t> maxTriangles);

/// Whether t may stay in the front of a minimal cut: it satisfies the criterion, or the criterion's bound
/// over its remover's sphere allows its error (so that the minimal cut is never larger than the saturated
/// one).
bool isSatisfied(const MultiTriangulation& mt, const Criterion& criterion, TriangleId t,
                 const Criterion::Corners& corners);

/// The worst severity among the triangles of a front. O(front), parallel.
double worstSeverity(const MultiTriangulation& mt, const Criterion& criterion, const Cut& cut);

/// The number of triangles of the saturated cut for an error of maxError everywhere, without taking it.
/// O(nodes in it).
std::uint32_t uniformTriangleCount(const MultiTriangulation& mt, double maxError);

/// The front of a closed set; of the first n nodes (closed by their order). Parallel, the same for any thread
/// count. Precondition: the set is closed.
Cut front(const MultiTriangulation& mt, const NodeSet& closed);
Cut frontOfPrefix(const MultiTriangulation& mt, std::uint32_t nodes);

/// Adds the ancestors of every member.
/// @return The number of members. O(nodes + members).
std::uint32_t closeUpwards(const MultiTriangulation& mt, NodeSet& set);

}  // namespace arete
