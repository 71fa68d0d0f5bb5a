// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "engine/mt/multitriangulation.h"
#include "io/store/amt/ranked_nodes.h"

namespace arete {

/// Parts of an MT from an unchecked file: its arrays have the sizes that engine/mt states and arbitrary
/// content. The parts have such sizes too and must be checked (checkMtIndices()). The parts of an MT that
/// keeps its laws keep them.

/// The first nodes of an MT, with their numbers: spans of the arrays of the whole, which is kept alive, and
/// copies of the removers and of the clusters' errors and spheres. Precondition: `nodes` is the number of all
/// nodes, or a smaller multiple of kNodesPerPage.
/// @return nothing if the arrays contradict their sizes. O(nodes), parallel.
std::optional<MultiTriangulation> prefixOfMt(const MultiTriangulation& whole, std::uint32_t nodes);

/// A copy of some nodes with all of their parents, renumbered in their order.
struct MtSubset {
  enum class Problem { none, parentMissing, damaged };
  Problem problem = Problem::none;
  MultiTriangulation mt;  ///< valid if there is no problem
};
/// Copies a set of nodes. Precondition: the set is ranked. O(nodes of the set), parallel.
MtSubset subsetOfMt(const MultiTriangulation& whole, const RankedNodes& nodes);

/// Adds all ancestors of the nodes of a set. O(nodes of the set) random reads.
/// @return false if the arrays are damaged
bool addParents(const MultiTriangulation& whole, RankedNodes& nodes);

}  // namespace arete
