// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/memory/uninitialized_vector.h"
#include "engine/mt/recorder.h"
#include "engine/simplify/live_mesh.h"
#include "engine/simplify/removal_record.h"
#include "engine/simplify/threshold_list.h"
#include "terrain/model/build_options.h"
#include "terrain/triangulation/rim.h"

namespace arete {

/// What all steps of a simplification work on. Different threads may work on different stars at once: which,
/// is said where they do (simplify.h).
///
/// Plan: LatticePlan or PointPlan. Errors: RasterError or PointError, see there for the interface:
///   Hole hole(star, apex)                        what the hole's triangles are measured against
///   hole.isUnconstrained()                       whether no border comes between its corners
///   hole.fromApex(i)                             where a corner lies from the apex
///   hole.maximum(i, j, m, limit)                 error of the triangle of three corners, or some larger than
///                                                the limit
///   hole.maximum(i, j, m, limit, bound)          the same, with the signed difference at the samples
///   hole.position(i), hole.apexPosition()        corners and apex on the plan, with their heights
///   hole.alongEdge(i, j)                         signed difference along an edge
///   hole.settle(floor)                           after a refill: samples find their new triangles
template <class Plan, class Errors>
struct SimplifyState {
  LiveMesh& mesh;
  const Plan& plan;
  Errors& errors;
  MtRecorder& recorder;
  Rim* rim;  ///< null unless rims may go
  const BuildOptions& options;
  MetricFrame metric;
  double heightRange = 0;
  double roundingSlack = 0;  ///< what the arithmetic of an error can be off by
  double boundSlack = 0;     ///< and that of a bound between samples

  ThresholdList waiting = {};
  UninitializedVector<RemovalRecord> notes = {};  ///< per vertex
  std::atomic<std::size_t> liveTriangles = 0;

  /// Whether v may go at all, as its star stands. On a border: only from a straight one, or as the rim
  /// allows.
  bool isRemovable(const Star& star, std::uint32_t v) const {
    if (!star.isOpen) return star.linkSize >= 3;
    if (star.linkSize < 3) return false;
    const std::uint32_t after = star.link[0], before = star.link[star.linkSize - 1];
    if (before == after) return false;  // at the end of a slit: Rim::closeVoid()
    const int turn = plan.orientation(before, v, after);
    if (turn == 0) return true;
    return turn < 0 && rim != nullptr && rim->mayFill(before, v, after);
  }
};

}  // namespace arete
