// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lists of a FitMesh lead through all of memory, because vertices are in the order of their levels. A
// sweep over such lists takes ten times as long as one over rows.
#include "terrain/fit/rows.h"

#include "engine/parallel/parallel_loops.h"

namespace arete {

FitRows::FitRows(const FitMesh& mesh)
    : first_(std::size_t(mesh.slotCount()) + 1, 0), perBoundEverywhere_(1 / mesh.bounds().everywhere) {
  for (std::uint32_t t = 0; t < mesh.slotCount(); ++t) {
    first_[t + 1] = first_[t];
    if (mesh.isLive(t)) mesh.forSamples(t, [&](std::uint32_t) { ++first_[t + 1]; });
  }
  rows_.resize(first_.back());
  if (!mesh.bounds().of.empty()) perBound_.resize(first_.back());
  parallelFor(IndexRange<std::uint32_t>(0, mesh.slotCount(), 256), [&](const auto& range) {
    for (std::uint32_t t = range.begin(); t != range.end(); ++t) {
      if (!mesh.isLive(t)) continue;
      const FitMesh::Weights weights = mesh.weights(mesh.triangle(t).corners);
      std::size_t at = first_[t];
      mesh.forSamples(t, [&](std::uint32_t s) {
        rows_[at] = {weights.of(mesh.plan(s)), mesh.mt().vertices().height(VertexId(s))};
        if (!perBound_.empty()) perBound_[at] = 1 / mesh.bounds().at(s);
        ++at;
      });
    }
  });
}

}  // namespace arete
