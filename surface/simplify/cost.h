// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "engine/mt/hole_limit.h"
#include "engine/simplify/removal_record.h"
#include "surface/error/floor_distance.h"
#include "surface/error/joint_distance.h"
#include "surface/error/samples.h"
#include "surface/simplify/fans.h"
#include "surface/simplify/state.h"

namespace arete {

/// The cost of a removal: the integral, over the part of the original that the star stands for, of the
/// squared distance to the fan that fills the hole; and, so that no triangle bridges a gap, that over the fan
/// of the squared distance to the star, from the triangles' middles; on a border also that over what the fan
/// covers beyond the original border; on a line, whose sides are compared each by itself, also that of the
/// line; more of it where the fan folds the surface. Its root, so that thresholds grow with areas. The fan
/// with the least is taken.
class SurfaceCost {
 public:
  explicit SurfaceCost(const SurfaceState& state) : s_(state) {}

  /// Costs are found exactly up to the threshold times this: the next levels use them.
  static constexpr double kExactUpTo = 3;

  /// Stores the cost of removing v, exactly if it is at most threshold * kExactUpTo, with the vertex around
  /// which the fan is as the witness.
  void evaluate(VertexId v, double threshold, RemovalRecord& record);
  /// Whether the fan of an exact record still keeps the topology and folds nothing: an edge that it needs may
  /// have been made elsewhere since, and triangles around the star may have turned.
  bool isStillValid(VertexId v, const RemovalRecord& record);

 private:
  /// The squared distance of a sample to the fan, in place and attributes together where they count.
  double squaredOf(const SurfaceSample& sample);
  /// The integral over the samples; some value above `limit` if it exceeds that.
  double integralOver(int corner, double limit);
  void collectSamples();
  /// The integral over the gap between the new border edge and the original border, where that runs inside.
  double integralBeyondBorder() const;
  /// The integral of what the new edge of a line leaves of the original line, as if it were of a surface.
  double integralAlongLine() const;

  static constexpr std::size_t kMostSamples = 64;

  const SurfaceState& s_;
  SurfaceHole hole_;
  std::vector<SurfaceSample> samples_;
  std::array<std::size_t, 2> otherSide_{};  // in samples_: those of side 1 of a line
  std::vector<double> wanted_;
  FloorDistance fan_;
  JointDistance joint_{s_.field};      // to the triangles of fan_, where attributes count
  std::array<FloorDistance, 2> star_;  // by side of a line
};

}  // namespace arete
