// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "engine/parallel/parallel_filter.h"
#include "engine/simplify/independent_set.h"
#include "engine/simplify/removal_batch.h"
#include "surface/simplify/state.h"

namespace arete {

/// Runs the levels of a simplification on all threads. Its steps are those of terrain's
/// (terrain/simplify/level.h): collect, evaluate, choose, remove, sew; and between choosing and removing, the
/// chosen vertices claim the edges that their fans will make, since two holes may ask for the same one.
class SurfaceLevels {
 public:
  explicit SurfaceLevels(SurfaceState& state)
      : s_(state),
        set_(state.mesh, state.records),
        batch_(state.mesh, state.recorder, state.thresholds, state.liveTriangles, nullptr) {}

  /// @param number of the level; different for all levels.
  /// @return how many vertices were removed.
  std::size_t level(double threshold, std::uint32_t number, MtRecorder::BatchOrder order);

 private:
  void evaluate(double threshold, std::uint32_t number);
  void claim();
  void remove(MtRecorder::BatchOrder order);

  SurfaceState& s_;
  IndependentSet set_;
  RemovalBatch batch_;
  ParallelFilter<VertexId> filter_;
  std::vector<VertexId> due_, chosen_;
  std::vector<std::uint8_t> linkSizes_;
  std::unordered_set<std::uint64_t> claimed_;  // edges, of a level
};

}  // namespace arete
