// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "engine/mt/multitriangulation.h"
#include "io/amt/ranked_nodes.h"

namespace arete {

/// Parts of an MT whose arrays have the sizes stated in MtArrays and may hold anything: they come from a file
/// that nobody has checked. What comes back has such sizes too, and is to be checked (checkMtIndices()). Of
/// an MT that keeps its laws the parts do.

/// The first nodes, and all that they need, under the numbers that they have: arrays that are the beginning
/// of those of the whole, which they keep alive; what removes triangles and what is known of blocks is
/// copied. Nothing where the beginning does not know its end. Precondition: so many nodes there are, and they
/// are all, or a multiple of kNodesPerPage. O(nodes), parallel.
std::optional<MultiTriangulation> prefixOfMt(const MultiTriangulation& whole, std::uint32_t nodes);

/// Some nodes with all of their parents, copied, numbered anew in the order that they have.
struct MtSubset {
  enum class Problem { none, parentMissing, damaged };
  Problem problem = Problem::none;
  MultiTriangulation mt;  ///< where there is none
};
/// Precondition: the nodes are ranked. O(nodes of the set), parallel.
MtSubset subsetOfMt(const MultiTriangulation& whole, const RankedNodes& nodes);

/// Adds the parents of all nodes, their parents and so on. False where the arrays are damaged. O(nodes of the
/// set), each with a look at places far from it.
bool addParents(const MultiTriangulation& whole, RankedNodes& nodes);

}  // namespace arete
