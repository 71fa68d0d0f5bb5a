// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/mt/multitriangulation.h"

namespace arete {

/// Bounds over consecutive nodes: of clusters of kNodesPerBlock, and after them of cluster groups of
/// kNodesPerPage (blocks and pages in the file format). Each entry has the largest saturated error of its
/// nodes and a ball that contains all of their spheres, so that one test of a criterion can exclude all its
/// nodes from a saturated cut.
struct NodeBlocks {
  std::vector<Sphere> sphere;
  std::vector<OutwardScale::Code> error;
};

/// The number of clusters of so many nodes; of clusters and cluster groups.
std::uint64_t nodeBlockCount(std::uint64_t nodes);
std::uint64_t nodeBlockAndPageCount(std::uint64_t nodes);

/// O(N), parallel; the result does not depend on the threads. Precondition: the spheres are finite.
NodeBlocks makeNodeBlocks(std::span<const OutwardScale::Code> saturatedError, std::span<const Sphere> sphere);

/// Whether the error, or the sphere, of an entry contains that of node n, as saturated cuts require. The test
/// of spheres is exact up to rounding in double.
bool holdsError(const MtArrays& a, std::uint64_t entry, std::uint32_t n);
bool holdsSphere(const MtArrays& a, std::uint64_t entry, std::uint32_t n);

/// The entries of node n: of its cluster and of its cluster group.
std::array<std::uint64_t, 2> blockEntries(std::uint64_t nodes, std::uint32_t n);

}  // namespace arete
