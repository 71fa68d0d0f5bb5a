// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "engine/memory/chunked_array.h"
#include "engine/memory/uninitialized_vector.h"
#include "engine/mt/multitriangulation.h"
#include "engine/parallel/stage_clock.h"

namespace arete {

/// What is recorded of a new triangle: its error and bounds, coded.
struct FloorCodes {
  std::uint16_t error = 0, below = 0, above = 0;
};

/// One vertex removal, read bottom-up: the star of a vertex (the node's ceiling) gives way to a triangulation
/// of the hole (its floor). Ids are the caller's: vertices as it numbers them, triangles by birth.
struct VertexRemoval {
  std::uint32_t vertex = 0;
  /// The star's link, counter-clockwise: k vertices of a closed star, k + 1 of an open one with k triangles.
  std::span<const std::uint32_t> link;
  bool isOpen = false;
  /// Metric positions of the link's vertices, then of the vertex itself.
  std::span<const Vec3> metricPositions;
  /// Birth ids of the star's triangles (vertex, link[i], link[i + 1]).
  std::span<const std::uint32_t> ceiling;
  /// For each, the removal that bore it (kNone for triangles of the finest triangulation).
  std::span<const std::uint32_t> ceilingCreator;
  /// Per new triangle. Their birth ids are consecutive, from firstBirth(i).
  std::span<const FloorCodes> floor;
};

/// A triangle that no removal took away: it belongs to the root.
struct SurvivingTriangle {
  std::uint32_t birth = 0;
  std::array<std::uint32_t, 3> corners{};
};

/// Records vertex removals from the finest triangulation down and turns them into a finished
/// multitriangulation.
///
/// Removals come in batches (levels of a piece of the ground), announced by any thread; the removals of a
/// batch may be recorded in any order and by any threads. The result depends only on how the batches follow
/// each other by their BatchOrder, and on the order in which each lists its removals. Births: the finest
/// triangulation's triangles are 0 .. F-1, each removal bears link.size() - 2 more.
///
/// Memory: about 95 bytes per removal while recording, about 165 at most while finishing, the result of
/// 130 among them.
class MtRecorder {
 public:
  static constexpr std::uint32_t kNone = MultiTriangulation::kNone;

  /// Where a batch stands among the others: by its group, then by its part, and among those of the same part
  /// as they were announced, which is one after the other. The removals that bore a batch's ceilings are of
  /// earlier batches.
  struct BatchOrder {
    std::uint32_t group = 0, part = 0;
    auto operator<=>(const BatchOrder&) const = default;
  };

  /// mostRemovals: no more will come.
  MtRecorder(std::uint32_t finestTriangles, std::uint32_t mostRemovals, OutwardScale scale,
             MetricFrame metric);

  const OutwardScale& scale() const { return scale_; }

  /// Announces removals, by the sizes of their links, in order. Returns the index of the first; the others
  /// follow. Thread-safe.
  std::uint32_t beginBatch(BatchOrder order, std::span<const std::uint8_t> linkSizes);
  /// The birth id of the first floor triangle of a removal.
  std::uint32_t firstBirth(std::uint32_t removal) const {
    return finestTriangles_ + slotBegin_[removal] - 2 * removal;
  }
  /// How many slots, one for each vertex of a link, come before those of a removal, also of the one after
  /// the last of a batch.
  std::uint32_t firstSlot(std::uint32_t removal) const { return slotBegin_[removal]; }
  /// What was recorded of a triangle; of the finest triangulation's, zeros. The removal that bore it is of an
  /// earlier batch.
  FloorCodes codes(std::uint32_t birth) const {
    return birth < finestTriangles_ ? FloorCodes{} : floor_[birth - finestTriangles_];
  }
  /// Records an announced removal: first what it is, then its saturated error and sphere. Thread-safe for
  /// different removals of a batch; the removals that bore its ceiling are of earlier batches. Precondition:
  /// link.size() as announced, 3 <= size.
  void record(std::uint32_t removal, const VertexRemoval& what);
  void saturate(std::uint32_t removal, const VertexRemoval& what);

  /// Asks for what saturate() and codes() read of a triangle of the ceiling and of the removal that bore it.
  [[gnu::always_inline]] void prefetch(std::uint32_t creator, std::uint32_t birth) const {
    if (creator == kNone) return;
    __builtin_prefetch(&saturated_[creator]);
    __builtin_prefetch(&sphere_[creator]);
    __builtin_prefetch(&floor_[birth - finestTriangles_]);
  }

  /// The finished MT. `vertexOrder`: on return, the caller's vertex of every MT vertex.
  /// `rootVertices`: the surviving vertices, in the order they shall have; `surviving`: the surviving
  /// triangles. The MT's vertices (MtArrays::vertices) are left to the caller: see withVertices(). Leaves the
  /// recorder empty. O(triangles), parallel; deterministic. `clock` may be null: see RunContext.
  MultiTriangulation finish(std::span<const std::uint32_t> rootVertices,
                            std::span<const SurvivingTriangle> surviving, std::uint32_t callerVertexCount,
                            UninitializedVector<std::uint32_t>& vertexOrder, StageClock* clock = nullptr);

 private:
  /// The removals in the order of nodes: by falling band, of one the later ones first. Parallel.
  UninitializedVector<std::uint32_t> byFallingBand();

  std::uint32_t finestTriangles_;
  OutwardScale scale_;
  MetricFrame metric_;

  struct Batch {
    BatchOrder order;
    std::uint32_t first, size;
  };
  std::mutex growing_;  // held by who adds to what follows
  std::vector<Batch> batches_;
  std::uint32_t removals_ = 0;

  ChunkedArray<std::uint32_t> slotBegin_;  // per removal, and the end
  ChunkedArray<std::uint32_t> vertex_;     // per removal
  ChunkedArray<std::uint16_t> saturated_;  // per removal
  ChunkedArray<Sphere> sphere_;            // per removal
  ChunkedArray<std::uint32_t> link_;       // per slot
  ChunkedArray<std::uint32_t> ceiling_;    // per slot; kNone in the last slot of an open star
  ChunkedArray<FloorCodes> floor_;         // per birth, from finestTriangles_ on
};

/// The same MT with the given vertices (and an owner for them beside its own).
MultiTriangulation withVertices(const MultiTriangulation& mt, const VertexArrays& vertices,
                                std::shared_ptr<const void> owner);

}  // namespace arete
