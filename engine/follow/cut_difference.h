// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "engine/cut/cut.h"

namespace arete {

/// One modification applied or undone.
struct CutStep {
  NodeId node;
  bool isRefinement = true;  ///< floor replaced by ceiling; false: the other way round
  bool operator==(const CutStep&) const = default;
};

/// What leads from one cut to another: first what only `from` has is undone, children first, then what only
/// `to` has is applied, parents first, so that every state between is a cut. As few steps as there can be.
/// Precondition: both are closed sets of the same MT. O(nodes of the MT).
std::vector<CutStep> difference(const NodeSet& from, const NodeSet& to);

/// The way back.
std::vector<CutStep> undone(std::span<const CutStep> steps);

/// Precondition: the steps fit the set, as those of difference() do.
void applySteps(std::span<const CutStep> steps, NodeSet& set);

}  // namespace arete
