// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/memory/uninitialized_vector.h"
#include "engine/mt/recorder.h"
#include "engine/simplify/independent_set.h"
#include "engine/simplify/live_mesh.h"
#include "engine/simplify/removal_record.h"
#include "engine/simplify/threshold_list.h"
#include "terrain/model/build_options.h"
#include "terrain/triangulation/rim.h"

namespace arete {

/// The data that all steps of a simplification share. Different threads may work on different stars at once;
/// simplify.h and engine/simplify/removal_batch.h say on which.
///
/// Plan: LatticePlan or PointPlan. Errors: RasterError or PointError, with the interface:
///   Hole hole(star, apex)                        the hole that the removal of apex leaves
///   hole.isUnconstrained()                       whether no border lies between its corners
///   hole.fromApex(i)                             a corner relative to the apex
///   hole.maximum(i, j, m, limit)                 error of the triangle of three corners, or some value
///                                                above the limit
///   hole.maximum(i, j, m, limit, bound, rounding)  the same, with the signed difference at the samples
///                                                and a bound of the result's rounding error
///   hole.isAbove(i, j, m, error, rounding, x)    whether the exact error exceeds x
///   hole.position(i), hole.apexPosition()        corner and apex, plan coordinates and height
///   hole.alongEdge(i, j)                         differences along an edge
///   hole.isAboveOnEdge(i, j, x)                  whether the exact error at a sample on the edge, if
///                                                maximum() does not include it, exceeds x
///   hole.settle(floor)                           after a refill: assigns samples to the new triangles
template <class Plan, class Errors>
struct SimplifyState {
  LiveMesh& mesh;
  const Plan& plan;
  Errors& errors;
  MtRecorder& recorder;
  Rim* rim;  ///< null unless rims are simplified
  const BuildOptions& options;
  MetricFrame metric;
  double heightRange = 0;
  double roundingSlack = 0;  ///< by how much two ways of computing an error may differ
  double boundSlack = 0;     ///< largest rounding error of a bound between samples

  ThresholdList thresholds = {};
  IndependentSet::Records records = {};
  std::atomic<std::size_t> liveTriangles = 0;

  /// Whether v can be removed, at any cost, from its present star. On a border: only if the border is
  /// straight at v, or if Rim::mayFill() allows it.
  bool isRemovable(const Star& star, VertexId v) const {
    if (!star.isOpen) return star.linkSize >= 3;
    if (star.linkSize < 3) return false;
    const VertexId after = star.link[0], before = star.link[star.linkSize - 1];
    if (before == after) return false;  // v is the end of a slit: Rim::closeVoid()
    const int turn = plan.orientation(before, v, after);
    if (turn == 0) return true;
    return turn < 0 && rim != nullptr && rim->mayFill(before, v, after);
  }
};

}  // namespace arete
