// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "engine/cut/cut.h"

namespace arete {

/// One node applied to a cut, or undone.
struct CutStep {
  NodeId node;
  bool isRefinement = true;  ///< true: the floor is replaced by the ceiling; false: the ceiling by the floor
  bool operator==(const CutStep&) const = default;
};

/// The steps that lead from one cut to another, as few as there can be: first the nodes that only `from` has
/// are undone, children first, then those that only `to` has are applied, parents first. Every state between
/// is a cut. Precondition: both are closed sets of the same MT. O(nodes of the MT).
std::vector<CutStep> difference(const NodeSet& from, const NodeSet& to);

/// The steps that undo the given ones, in reverse order.
std::vector<CutStep> undone(std::span<const CutStep> steps);

/// Applies steps to a set. Precondition: they fit the set, as those of difference() do.
void applySteps(std::span<const CutStep> steps, NodeSet& set);

}  // namespace arete
