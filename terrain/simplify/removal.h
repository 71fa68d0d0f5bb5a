// SPDX-License-Identifier: GPL-3.0-or-later
//
// A removal: fill the star's hole with the floor whose error is the cost, measure the floor, record the
// modification, rewrite the star, update the records of its link.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "engine/base/branchless.h"
#include "engine/simplify/floor_joins.h"
#include "terrain/simplify/measured_floor.h"
#include "terrain/simplify/state.h"
#include "terrain/triangulation/delaunay_hole.h"

namespace arete {

/// Removes vertices, on one thread.
template <class Plan, class Errors>
class VertexRemover {
 public:
  explicit VertexRemover(SimplifyState<Plan, Errors>& state) : s_(state) {}

  /// Prefetches what remove() reads.
  [[gnu::always_inline]] void prefetch(const Star& star) const {
    for (int k = 0; k < star.triangleCount; ++k) {
      const LiveMesh::Triangle& triangle = s_.mesh.triangles[star.slot(k)];
      s_.recorder.prefetch(triangle.creator, triangle.recorderId);
    }
    for (const VertexId u : star.linkView()) {
      __builtin_prefetch(&s_.records[u], 1);
      s_.thresholds.prefetch(u);
      __builtin_prefetch(&s_.mesh.vertexHalfedge[u], 1);
    }
    s_.errors.prefetch(star);
  }

  /// Removes v, whose cost is known exactly.
  /// @param star of v.
  /// @param floor the measured floor that RemovalCost has kept; empty: it is found and measured here.
  /// @param seams one for each vertex of the link, filled in; the caller joins them.
  void remove(VertexId v, const Star& star, MeasuredFloor& floor, RemovalId removal, std::span<Seam> seams) {
    typename Errors::Hole hole(s_.errors, star, v);
    if (floor.isEmpty()) fill(v, star, hole, floor);
    const FloorJoins joins(floor.triangulation);
    encodeBounds(star, hole, joins, floor);
    const VertexRemoval what = describe(v, star, hole, floor.triangulation.size);
    s_.recorder.record(removal, what);
    s_.recorder.saturate(removal, what);
    refill(s_.mesh, star, floor.triangulation, joins, s_.recorder.firstFloorTriangle(removal), removal,
           seams);
    hole.settle(floor.triangulation);
    updateLink(v, star);
    s_.mesh.vertexHalfedge[v] = HalfedgeId();
  }

 private:
  void fill(VertexId v, const Star& star, const typename Errors::Hole& hole, MeasuredFloor& floor) {
    if (s_.options.shape == HoleShape::dataDependent) {
      // The cost was found with other roundings and is stored as a float.
      const double limit =
          std::nextafter(s_.records[v].cost, std::numeric_limits<float>::infinity()) + s_.roundingSlack;
      fillShortest(star.linkSize, hole, s_.options.minimumAspect, limit, floor);
      if (!floor.isEmpty()) return;
    }
    const bool isUnconstrained = s_.options.shape == HoleShape::delaunay && hole.isUnconstrained();
    floor.triangulation = triangulateHoleDelaunay(star.linkSize, hole, isUnconstrained);
    measure(hole, floor);
  }

  /// Errors and bounds of the floor: of the samples inside each triangle, and along its edges.
  void encodeBounds(const Star& star, const typename Errors::Hole& hole, const FloorJoins& joins,
                    MeasuredFloor& floor) {
    for (int d = 0; d < joins.diagonalCount; ++d) {
      const FloorJoins::Diagonal& diagonal = joins.diagonals[d];
      const EdgeDifference edge = hole.alongEdge(diagonal.from, diagonal.to);
      floor.bounds[diagonal.forth.triangle].include(edge.bound);
      floor.bounds[diagonal.back.triangle].include(edge.bound);
      if constexpr (!Errors::kCoversEdges) edges_[d] = {edge.error, edge.rounding};
    }
    const OutwardScale& scale = s_.recorder.scale();
    const auto encode = [&](double bound) { return scale.encode(outward(bound)); };
    for (int f = 0; f < floor.triangulation.size; ++f)
      codes_[f] = {errorCode(hole, floor, f), encode(floor.bounds[f].below), encode(floor.bounds[f].above)};
    if constexpr (!Errors::kCoversEdges)
      for (int d = 0; d < joins.diagonalCount; ++d) {
        const FloorJoins::Diagonal& diagonal = joins.diagonals[d];
        const OutwardScale::Code code =
            edgeCode(hole, diagonal.from, diagonal.to, edges_[d].error, edges_[d].rounding);
        for (const int f : {int(diagonal.forth.triangle), int(diagonal.back.triangle)})
          codes_[f].error = std::max(codes_[f].error, code);
      }
    // What is stored with the star's triangles holds for their edges too. So a rim edge is scanned only if
    // the bounds of its former triangle exceed those of the floor's triangle, which is rare, or the error of
    // points.
    const int corners = star.linkSize;
    std::array<std::uint8_t, kMaxHoleCorners> scanned;
    int count = 0;
    for (int i = 0; i < star.triangleCount; ++i) {
      const FloorCodes own = codes_[joins.rim[i].triangle],
                       beside = s_.recorder.codes(s_.mesh.triangles[star.slot(i)].recorderId);
      scanned[count] = static_cast<std::uint8_t>(i);
      count += (beside.below > own.below) | (beside.above > own.above) |
               (!Errors::kCoversEdges & (beside.error > own.error));
    }
    if (star.isOpen) scanned[count++] = static_cast<std::uint8_t>(corners - 1);
    for (int k = 0; k < count; ++k) {
      const int i = scanned[k];
      FloorCodes& own = codes_[joins.rim[i].triangle];
      const int next = i + 1 < corners ? i + 1 : 0;
      const EdgeDifference edge = hole.alongEdge(i, next);
      const std::uint16_t below = encode(edge.bound.below), above = encode(edge.bound.above);
      own = {own.error, std::max(own.below, below), std::max(own.above, above)};
      if constexpr (!Errors::kCoversEdges)
        own.error = std::max(own.error, edgeCode(hole, i, next, edge.error, edge.rounding));
    }
  }

  /// The spans refer to arrays of this object and are valid until the next removal.
  VertexRemoval describe(VertexId v, const Star& star, const typename Errors::Hole& hole, int floorSize) {
    for (int i = 0; i < star.triangleCount; ++i) {
      ceiling_[i] = s_.mesh.triangles[star.slot(i)].recorderId;
      creator_[i] = s_.mesh.triangles[star.slot(i)].creator;
    }
    const int corners = star.linkSize;
    for (int i = 0; i < corners; ++i) positions_[i] = s_.metric.toMetric(hole.position(i));
    positions_[corners] = s_.metric.toMetric(hole.apexPosition());

    const auto size = [](int n) { return static_cast<std::size_t>(n); };
    VertexRemoval what;
    what.vertex = v;
    what.link = star.linkView();
    what.isOpen = star.isOpen;
    what.metricPositions = {positions_.data(), size(corners + 1)};
    what.ceiling = {ceiling_.data(), size(star.triangleCount)};
    what.ceilingCreator = {creator_.data(), size(star.triangleCount)};
    what.floor = {codes_.data(), size(floorSize)};
    return what;
  }

  /// Records at the neighbours of v that v is removed. Two stars can share a link vertex: both threads store
  /// the same values.
  void updateLink(VertexId v, const Star& star) {
    using State = RemovalRecord::State;
    const bool isWitnessUnknown = s_.options.shape != HoleShape::delaunay || star.isOpen;
    for (const VertexId u : star.linkView()) {
      RemovalRecord& record = s_.records[u];
      const bool isWitnessGone = isWitnessUnknown | record.isWitnessedBy(v);
      std::atomic_ref(record.isTouched).store(1, std::memory_order_relaxed);
      storeIf(isWitnessGone, record.isWitnessGone, 1);
      s_.thresholds.makeDueIf(
          (isWitnessGone | (record.state == State::stuck)) & (record.state != State::fixed), u);
    }
  }

  /// A bound enlarged by the rounding of the scan, as it must hold exactly. 0 stays 0. (A multiplication
  /// instead of a branch: zeros are not predictable.)
  double outward(double x) const { return (x * (1 + 1e-9) + s_.boundSlack) * (x == 0 ? 0 : 1); }
  /// The least code whose magnitude is at least an exact error. Where codes lie within the rounding error of
  /// the computed one, exact arithmetic decides: with integer heights errors of exactly 1 are common, and a
  /// tolerance of 1 must admit them.
  /// @param isAbove  whether the exact error exceeds a bound
  template <class IsAbove>
  OutwardScale::Code leastCode(double error, double rounding, const IsAbove& isAbove) const {
    const OutwardScale& scale = s_.recorder.scale();
    OutwardScale::Code low = scale.encode(std::max(0.0, error - rounding));
    if (scale.decode(low) >= error + rounding) [[likely]]
      return low;
    if (!isAbove(scale.decode(low))) return low;
    // No error exceeds the range of the heights, however much the arithmetic may have lost.
    OutwardScale::Code high =
        scale.encode(std::min(error + rounding, static_cast<double>(scale.decode(OutwardScale::kMaxCode))));
    while (low < high) {
      const auto middle = static_cast<OutwardScale::Code>((low + high) / 2);
      if (isAbove(scale.decode(middle)))
        low = static_cast<OutwardScale::Code>(middle + 1);
      else
        high = middle;
    }
    return low;
  }
  /// The code of the error of the samples on an edge.
  OutwardScale::Code edgeCode(const typename Errors::Hole& hole, int from, int to, double error,
                              double rounding) const {
    return leastCode(error, rounding, [&](double bound) { return hole.isAboveOnEdge(from, to, bound); });
  }
  /// The code of the error of triangle f.
  OutwardScale::Code errorCode(const typename Errors::Hole& hole, const MeasuredFloor& floor, int f) const {
    return leastCode(floor.errors[f], floor.roundings[f], [&](double bound) {
      const auto [i, j, m] = floor.triangulation.triangles[f];
      return hole.isAbove(i, j, m, floor.errors[f], floor.roundings[f], bound);
    });
  }

  SimplifyState<Plan, Errors>& s_;
  struct EdgeError {
    double error, rounding;
  };
  // Members, so that no removal initialises them.
  std::array<EdgeError, kMaxHoleCorners> edges_;
  std::array<FloorCodes, kMaxHoleCorners> codes_;
  std::array<RecorderId, kMaxHoleCorners> ceiling_;
  std::array<RemovalId, kMaxHoleCorners> creator_;
  std::array<Vec3, kMaxHoleCorners + 1> positions_;
};

}  // namespace arete
