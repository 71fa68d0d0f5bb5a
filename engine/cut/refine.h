// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "engine/cut/cut.h"

namespace arete {

/// The nodes of a minimal cut under a budget or a deadline, refined in the order of the options: greedy
/// insertion [GarlandHeckbert1995] on the graph of an MT. In the order worst first, the result is the last
/// state whose worst severity was the least of all. (Errors are not monotone along the graph: on white noise,
/// refinement can raise the largest error.) O(n log n), n the triangles visited. Errors: interrupted.
/// Precondition: the budget, if any, is at least the root's triangles.
Result<NodeCut> refineWithin(const MultiTriangulation& mt, const Criterion& criterion,
                             const CutOptions& options, const RunContext& context);

/// Collects n and the ancestors that must be applied before it.
/// @param claim claim(node index) returns true once for every node that is not yet a member.
/// @param missing Receives the nodes, parents first.
template <class Claim>
void collectMissing(const MultiTriangulation& mt, std::uint32_t n, const Claim& claim,
                    std::vector<std::uint32_t>& missing) {
  missing.clear();
  if (claim(n)) missing.push_back(n);
  for (std::size_t i = 0; i < missing.size(); ++i)
    for (const std::uint32_t t : mt.floor(NodeId(missing[i]))) {
      const NodeId parent = mt.creator(TriangleId(t));
      if (parent.isValid() && claim(parent.index())) missing.push_back(parent.index());
    }
  std::sort(missing.begin(), missing.end());
}

}  // namespace arete
