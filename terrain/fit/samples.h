// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/cut/cut.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// Lists of the samples that each triangle of a cut covers. Every vertex of the multitriangulation is a
/// sample and is in the list of exactly one triangle; a sample on an edge or at a corner is listed by one of
/// the triangles there, whose planes agree.
struct FitSamples {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  std::vector<std::uint32_t> first;  ///< per triangle of the cut: its first sample, an MT vertex; or kNone
  std::vector<std::uint32_t> next;   ///< per MT vertex: the next sample of the same triangle; or kNone
};

/// Assigns the samples to the triangles of a cut. Raster: every triangle is scan-converted in integers,
/// O(samples). Points: each one is followed from the node that inserts it to the first node of the cut, by
/// exact predicates, O(samples * depth), parallel. The result is the same for any number of threads.
/// Precondition: `cut` is the front of `nodes`. The positions need not be those of a triangulation: a file
/// may hold any. Errors: invalidData: a triangle is not counter-clockwise, triangles overlap, no triangle
/// covers some sample; interrupted. Where there are none, all triangles of the cut are counter-clockwise.
/// @throw std::bad_alloc
Result<FitSamples> shareSamples(const MultiTriangulation& mt, const Cut& cut, const NodeSet& nodes,
                                const RunContext& context);

/// The node set of a cut, found from its vertices. O(nodes).
NodeSet nodesOf(const MultiTriangulation& mt, const Cut& cut);

}  // namespace arete
