// SPDX-License-Identifier: GPL-3.0-or-later
//
// A removal: the star's hole is filled with the floor that its cost is of, the floor is measured, the
// modification recorded, the star rewritten and its link told.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "engine/simplify/floor_joins.h"
#include "terrain/simplify/measured_floor.h"
#include "terrain/simplify/state.h"
#include "terrain/triangulation/delaunay_hole.h"

namespace arete {

/// What a thread removes vertices with.
template <class Plan, class Errors>
class VertexRemover {
 public:
  explicit VertexRemover(SimplifyState<Plan, Errors>& state) : s_(state) {}

  /// Asks for what remove() will read.
  [[gnu::always_inline]] void prefetch(const Star& star) const {
    for (int k = 0; k < star.triangleCount; ++k) {
      const LiveMesh::Triangle& triangle = s_.mesh.triangles[star.triangle(k)];
      s_.recorder.prefetch(triangle.creator, triangle.birth);
    }
    for (const std::uint32_t u : star.linkView()) {
      __builtin_prefetch(&s_.notes[u], 1);
      s_.waiting.prefetch(u);
      __builtin_prefetch(&s_.mesh.vertexHalfedge[u], 1);
    }
    s_.errors.prefetch(star);
  }

  /// Removes v, whose cost is known exactly. `star`: of v. `floor`: what the hole is to be filled with, as a
  /// look has kept it, or empty. removal: its number in the recorder. `seams`: one for each vertex of the
  /// link, to be sewn.
  void remove(std::uint32_t v, const Star& star, MeasuredFloor& floor, std::uint32_t removal,
              std::span<Seam> seams) {
    typename Errors::Hole hole(s_.errors, star, v);
    if (floor.isEmpty()) fill(v, star, hole, floor);
    const FloorJoins joins(floor.triangulation);
    encodeBounds(star, hole, joins, floor);
    const VertexRemoval what = describe(v, star, hole, floor.triangulation.size);
    s_.recorder.record(removal, what);
    s_.recorder.saturate(removal, what);
    refill(s_.mesh, star, floor.triangulation, joins, s_.recorder.firstFloorTriangle(removal), removal, seams);
    hole.settle(floor.triangulation);
    tellLink(v, star);
    s_.mesh.vertexHalfedge[v] = LiveMesh::kNone;
  }

 private:
  void fill(std::uint32_t v, const Star& star, const typename Errors::Hole& hole, MeasuredFloor& floor) {
    if (s_.options.shape == HoleShape::dataDependent) {
      // The cost was found from other corners, in other roundings, and is kept in few digits.
      const double limit =
          std::nextafter(s_.notes[v].cost, std::numeric_limits<float>::infinity()) + s_.roundingSlack;
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
      const SignedBound bound = hole.alongEdge(diagonal.from, diagonal.to);
      floor.bounds[diagonal.forth.triangle].include(bound);
      floor.bounds[diagonal.back.triangle].include(bound);
    }
    const OutwardScale& scale = s_.recorder.scale();
    const auto encode = [&](double bound) { return scale.encode(outward(bound)); };
    for (int f = 0; f < floor.triangulation.size; ++f)
      codes_[f] = {scale.encode(withoutRounding(floor.errors[f])), encode(floor.bounds[f].below),
                   encode(floor.bounds[f].above)};
    // The bounds of the star's triangles hold for their edges: most often the rim adds nothing to those of
    // the floor, and need not be looked at.
    const int corners = star.linkSize;
    std::array<std::uint8_t, kMaxHoleCorners> telling;
    int count = 0;
    for (int i = 0; i < star.triangleCount; ++i) {
      const FloorCodes own = codes_[joins.rim[i].triangle],
                       beside = s_.recorder.codes(s_.mesh.triangles[star.triangle(i)].birth);
      telling[count] = static_cast<std::uint8_t>(i);
      count += (beside.below > own.below) | (beside.above > own.above);
    }
    if (star.isOpen) telling[count++] = static_cast<std::uint8_t>(corners - 1);
    for (int k = 0; k < count; ++k) {
      const int i = telling[k];
      FloorCodes& own = codes_[joins.rim[i].triangle];
      const SignedBound bound = hole.alongEdge(i, i + 1 < corners ? i + 1 : 0);
      const std::uint16_t below = encode(bound.below), above = encode(bound.above);
      own = {own.error, std::max(own.below, below), std::max(own.above, above)};
    }
  }

  /// In lists of this remover's, until the next removal.
  VertexRemoval describe(std::uint32_t v, const Star& star, const typename Errors::Hole& hole,
                         int floorSize) {
    for (int i = 0; i < star.triangleCount; ++i) {
      ceiling_[i] = s_.mesh.triangles[star.triangle(i)].birth;
      bearer_[i] = s_.mesh.triangles[star.triangle(i)].creator;
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
    what.ceilingCreator = {bearer_.data(), size(star.triangleCount)};
    what.floor = {codes_.data(), size(floorSize)};
    return what;
  }

  /// Two stars can share a link vertex: both write the same value. What a neighbour must forget cannot be
  /// foreseen, so it is told where to write instead of whether.
  void tellLink(std::uint32_t v, const Star& star) {
    using State = RemovalRecord::State;
    const bool isWitnessUnknown = s_.options.shape != HoleShape::delaunay || star.isOpen;
    for (const std::uint32_t u : star.linkView()) {
      RemovalRecord& note = s_.notes[u];
      const bool isWitnessGone = isWitnessUnknown | note.isWitnessedBy(v);
      std::atomic_ref(note.isTouched).store(1, std::memory_order_relaxed);
      std::atomic_ref(isWitnessGone ? note.isWitnessGone : note.isTouched)
          .store(1, std::memory_order_relaxed);
      s_.waiting.wakeIf((isWitnessGone | (note.state == State::stuck)) & (note.state != State::fixed), u);
    }
  }

  /// Bounds go beyond the rounding of the scan itself: they prove things. (No branch: nothing foretells
  /// zeros.)
  double outward(double x) const { return (x * (1 + 1e-9) + s_.boundSlack) * (x == 0 ? 0 : 1); }
  /// An error that is a code but for the last bits of its arithmetic is that code: integer heights make
  /// errors of exactly 1 common, and a tolerance of 1 must take them. The bits are far below what "equal to
  /// the bound" allows.
  double withoutRounding(double x) const { return std::max(0.0, x - s_.roundingSlack); }

  SimplifyState<Plan, Errors>& s_;
  // Kept for the next removal, as clearing them takes longer than many a step.
  std::array<FloorCodes, kMaxHoleCorners> codes_;
  std::array<std::uint32_t, kMaxHoleCorners> ceiling_, bearer_;
  std::array<Vec3, kMaxHoleCorners + 1> positions_;
};

}  // namespace arete
