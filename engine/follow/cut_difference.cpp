// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parents have smaller indices than their children: falling order undoes children first, rising order applies
// parents first.
#include "engine/follow/cut_difference.h"

namespace arete {

std::vector<CutStep> difference(const NodeSet& from, const NodeSet& to) {
  std::vector<CutStep> steps;
  const auto count = static_cast<std::uint32_t>(from.size());
  for (std::uint32_t n = count; n-- > 0;)
    if (from[n] && !to[n]) steps.push_back({NodeId(n), false});
  for (std::uint32_t n = 0; n < count; ++n)
    if (!from[n] && to[n]) steps.push_back({NodeId(n), true});
  return steps;
}

std::vector<CutStep> undone(std::span<const CutStep> steps) {
  std::vector<CutStep> back;
  back.reserve(steps.size());
  for (std::size_t i = steps.size(); i-- > 0;) back.push_back({steps[i].node, !steps[i].isRefinement});
  return back;
}

void applySteps(std::span<const CutStep> steps, NodeSet& set) {
  for (const CutStep& step : steps) set[step.node.index()] = step.isRefinement ? 1 : 0;
}

}  // namespace arete
