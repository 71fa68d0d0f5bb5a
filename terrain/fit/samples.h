// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/cut/cut.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// Which samples the triangles of a cut cover: every vertex of the multitriangulation is a sample, and in the
/// list of one triangle. One on an edge or a corner is in the list of any of its triangles, whose planes
/// agree there.
struct FitSamples {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  std::vector<std::uint32_t> first;  ///< per triangle of the cut: its first sample, an MT vertex
  std::vector<std::uint32_t> next;   ///< per MT vertex
};

/// Raster: the rows of every triangle are scanned, in integers. O(samples). Points: every one walks up from
/// the node that inserts it to the first node of the cut, by exact predicates. O(samples * depth), parallel.
/// The same for any number of threads. Errors: interrupted; invalidData, a model whose triangles do not cover
/// a sample. Precondition: `cut` is the front of `nodes`.
Result<FitSamples> shareSamples(const MultiTriangulation& mt, const Cut& cut, const NodeSet& nodes,
                                const RunContext& context);

/// The nodes of a cut, from its vertices. O(nodes).
NodeSet nodesOf(const MultiTriangulation& mt, const Cut& cut);

}  // namespace arete
