// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "engine/cut/cut.h"

namespace arete {

/// The nodes of a minimal cut that a budget or a deadline may end early, refined in the order of the options.
/// With a budget or a deadline spent worst first, the state handed out is the last one whose worst triangle
/// was the least (errors are not monotone down the graph: on white noise refining can raise the largest
/// error). Precondition: the budget, if any, holds the root. Errors: interrupted.
Result<NodeCut> refineWithin(const MultiTriangulation& mt, const Criterion& criterion,
                             const CutOptions& options, const RunContext& context);

/// The nodes that must enter before n can, and n: parents first. claim(node index): true once for every node
/// that is not in yet.
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
