// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/criterion.h"
#include "engine/multitriangulation.h"
#include "engine/result.h"
#include "engine/run_context.h"

namespace arete {

/// A set of nodes, one byte each: 0 = out. Closed when the creators of every member's floor are members too.
using NodeSet = std::vector<std::uint8_t>;

/// The front of a cut: a conforming, positively oriented triangulation of the whole domain (law 5).
struct Cut {
  std::vector<std::uint32_t> vertices;  ///< MT vertex of each vertex of the front
  std::vector<std::array<std::uint32_t, 3>>
      triangles;                   ///< indices into `vertices`, counter-clockwise in the plan
  std::vector<std::uint32_t> ids;  ///< MT triangle of each triangle
  double achievedError = 0;        ///< largest error of its triangles, as stored (outwards)
  std::uint32_t nodes = 0;         ///< nodes in the cut
};

/// Two ways to take a cut, both exact (DESIGN, "Two ways to take a cut").
enum class CutMethod {
  minimal,    ///< the least cut for the criterion: a walk from the root, forcing ancestors
  saturated,  ///< independent tests per node, parallel: a few percent more triangles, no walk
};

struct CutOptions {
  CutMethod method = CutMethod::minimal;
  /// At most this many triangles, spent where the error is largest; the criterion may stay unmet.
  std::optional<std::uint32_t> maxTriangles{};
};

/// The front of the least cut (or of the saturated cut) whose triangles all satisfy the criterion, or have
/// nothing finer. Errors: usage when the budget is below the root's count, when the saturated cut is asked
/// for a criterion without a bound over a sphere; interrupted. Minimal: O(triangles visited), visiting the
/// cut and its ancestors; with a budget times log. Saturated: O(N) at most in general, O(size of the cut) for
/// a uniform error.
Result<Cut> takeCut(const MultiTriangulation& mt, const Criterion& criterion, const CutOptions& options = {},
                    const RunContext& context = {});

/// The nodes of the cuts above, without their fronts.
Result<NodeSet> minimalNodes(const MultiTriangulation& mt, const Criterion& criterion,
                             std::optional<std::uint32_t> maxTriangles, const RunContext& context = {});
Result<NodeSet> saturatedNodes(const MultiTriangulation& mt, const Criterion& criterion,
                               std::optional<std::uint32_t> maxTriangles, const RunContext& context = {});

/// Number of nodes whose saturated error exceeds E: the nodes of the uniform saturated cut are 0 .. n-1.
/// O(log N).
std::uint32_t uniformPrefix(const MultiTriangulation& mt, double maxError);

/// The front of a closed set; of the first n nodes (closed by their order). Parallel, the same for any thread
/// count. Precondition: the set is closed.
Cut front(const MultiTriangulation& mt, const NodeSet& closed);
Cut frontOfPrefix(const MultiTriangulation& mt, std::uint32_t nodes);

/// Adds the ancestors of every member. Returns the number of members. O(members).
std::uint32_t closeUpwards(const MultiTriangulation& mt, NodeSet& set);

}  // namespace arete
