// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/mt/multitriangulation.h"

namespace arete {

/// What is known of runs of nodes: blocks of kNodesPerBlock, and after them pages of kNodesPerPage. Each has
/// the largest saturated error of its nodes and a ball that holds all of their spheres, so a criterion's
/// bound over the ball says of all its nodes at once that none is in a saturated cut.
struct NodeBlocks {
  std::vector<Sphere> sphere;
  std::vector<OutwardScale::Code> error;
};

/// Sizes of both arrays for so many nodes: blocks, then pages.
std::uint64_t nodeBlockCount(std::uint64_t nodes);
std::uint64_t nodeBlockAndPageCount(std::uint64_t nodes);

/// O(N), parallel, deterministic. The spheres are finite.
NodeBlocks makeNodeBlocks(std::span<const OutwardScale::Code> saturatedError, std::span<const Sphere> sphere);

/// What a saturated cut leans on: node n's error at most, and its sphere inside, those of entry e. The test
/// of spheres is exact up to rounding in double.
bool holdsError(const MtArrays& a, std::uint64_t entry, std::uint32_t n);
bool holdsSphere(const MtArrays& a, std::uint64_t entry, std::uint32_t n);

/// The entries of node n: its block's, its page's.
std::array<std::uint64_t, 2> blockEntries(std::uint64_t nodes, std::uint32_t n);

}  // namespace arete
