// SPDX-License-Identifier: GPL-3.0-or-later
//
// A walk through a part makes the steps of a walk through the whole until it meets a triangle that is too
// coarse and that no node of the part removes. A refinement, worst triangle first, makes the same steps while
// every such triangle is better than the worst other one that is too coarse, because it has not come to it.
#include "engine/cut/missing.h"

#include <algorithm>
#include <limits>

#include "engine/parallel/parallel_loops.h"

namespace arete {
namespace {

constexpr double kFineEnough = -1;

/// The severity of a triangle that is too coarse.
double severityOf(const MultiTriangulation& mt, const Criterion& criterion, const Cut& cut, std::size_t i) {
  const TriangleId t(cut.ids[i]);
  Criterion::Corners corners = cut.triangles[i];
  for (std::uint32_t& corner : corners) corner = cut.vertices[corner];
  return isSatisfied(mt, criterion, t, corners) ? kFineEnough : criterion.severity(mt, t, corners);
}

}  // namespace

std::vector<std::uint32_t> missingIn(const MultiTriangulation& mt, const Criterion& criterion, bool isRefined,
                                     const Cut& cut) {
  if (mt.arrays().missing.empty()) return {};
  std::vector<double> severity(cut.ids.size(), kFineEnough);
  parallelFor(IndexRange<std::size_t>(0, cut.ids.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const TriangleId t(cut.ids[i]);
      // Where a cut is complete, every triangle that a node of the part removes is fine enough.
      const bool isRefinable = isRefined && !cut.isComplete && mt.remover(t).isValid();
      if (isRefinable || mt.isRemoverMissing(t)) severity[i] = severityOf(mt, criterion, cut, i);
    }
  });
  double worst = kFineEnough, worstMissing = kFineEnough;
  for (std::size_t i = 0; i < severity.size(); ++i) {
    double& largest = mt.isRemoverMissing(TriangleId(cut.ids[i])) ? worstMissing : worst;
    largest = std::max(largest, severity[i]);
  }
  std::vector<std::uint32_t> missing;
  if (worstMissing == kFineEnough || (worst != kFineEnough && worstMissing < worst)) return missing;
  for (std::size_t i = 0; i < severity.size(); ++i)
    if (severity[i] != kFineEnough && mt.isRemoverMissing(TriangleId(cut.ids[i])))
      missing.push_back(cut.ids[i]);
  return missing;
}

}  // namespace arete
