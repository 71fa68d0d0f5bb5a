// SPDX-License-Identifier: GPL-3.0-or-later
//
// In each patch, the part that edges of two triangles join, the fewer triangles are turned; of equally many,
// those that turn against the first one. A patch that is not orientable stays as it is: whatever is turned,
// one of its edges would disagree.
#include <utility>

#include "surface/repair/draft.h"
#include "surface/topology/components.h"
#include "surface/topology/edges.h"

namespace arete::repair_passes {

void orient(Draft& draft) {
  auto& triangles = draft.mesh.triangles;
  const MeshEdges edges(triangles, draft.mesh.positions.size());
  const MeshOrientation orientation(edges);
  std::vector<std::uint64_t> size(orientation.contradiction.size(), 0), turned(size);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    ++size[orientation.patchOf[t]];
    turned[orientation.patchOf[t]] += orientation.isTurned[t];
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t patch = orientation.patchOf[t];
    if (!orientation.isOrientable(patch, edges)) continue;
    const bool turnsOthers = 2 * turned[patch] > size[patch];
    if ((orientation.isTurned[t] != 0) == turnsOthers) continue;
    std::swap(triangles[t][1], triangles[t][2]);
    ++draft.counts.turnedTriangles;
  }
}

}  // namespace arete::repair_passes
