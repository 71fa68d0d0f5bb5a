// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "engine/base/ids.h"
#include "engine/memory/chunked_array.h"
#include "engine/memory/uninitialized_vector.h"
#include "engine/mt/multitriangulation.h"
#include "engine/parallel/stage_clock.h"

namespace arete {

/// The number of a recorded removal, in the order in which removals were announced. Invalid (the default):
/// the triangle is of the finest triangulation, and no removal created it.
using RemovalId = Id<struct RemovalTag>;
/// The number of a triangle while recording (MtRecorder).
using RecorderId = Id<struct RecorderTag>;

/// What is recorded of a new triangle: its error and signed bounds, coded by the recorder's OutwardScale.
struct FloorCodes {
  std::uint16_t error = 0, below = 0, above = 0;
};

/// One vertex removal, from fine to coarse: the star of a vertex (the node's ceiling) is replaced by a
/// triangulation of the hole (its floor). Vertices have the caller's ids.
struct VertexRemoval {
  VertexId vertex;
  /// The star's link, counter-clockwise: k vertices of a closed star, k + 1 of an open one with k triangles.
  std::span<const VertexId> link;
  bool isOpen = false;
  /// Metric positions of the link's vertices, then of the vertex itself.
  std::span<const Vec3> metricPositions;
  /// The star's triangles (vertex, link[i], link[i + 1]).
  std::span<const RecorderId> ceiling;
  /// For each, the removal that created it (invalid for triangles of the finest triangulation).
  std::span<const RemovalId> ceilingCreator;
  /// Of each new triangle. Their recorder ids are consecutive, from firstFloorTriangle(i).
  std::span<const FloorCodes> floor;
};

/// A triangle that no removal took away: it belongs to the root.
struct SurvivingTriangle {
  RecorderId id;
  std::array<VertexId, 3> corners{};
};

/// Records vertex removals from the finest triangulation to the coarsest and turns them into a finished
/// multitriangulation [DeFlorianiMagilloPuppo1998].
///
/// Removals come in batches (the levels of a tile), which any thread announces. The removals of a batch may
/// be recorded in any order and by any threads. The result depends only on the BatchOrder of the batches, and
/// on the order in which each lists its removals.
///
/// Recorder ids number the triangles while recording: the finest triangulation's are 0 .. F-1, and each
/// removal adds link.size() - 2 more, in the order in which removals were announced. finish() renumbers all
/// of them.
///
/// Memory: about 95 bytes per removal while recording; at most about 165 in finish(), including the result of
/// 130.
class MtRecorder {
 public:
  /// The position of a batch among the others: by its group, then by its part. Batches of equal order follow
  /// each other as they were announced, and one thread announces them. The removals that created a batch's
  /// ceilings belong to earlier batches.
  struct BatchOrder {
    std::uint32_t group = 0, part = 0;
    auto operator<=>(const BatchOrder&) const = default;
  };

  /// @param finestTriangles The number F of triangles of the finest triangulation.
  /// @param mostRemovals No more than these will be announced. Reserves addresses, takes no memory.
  /// @param scale Of the codes that are recorded.
  /// @param metric The frame of the metric positions that are recorded.
  MtRecorder(std::uint32_t finestTriangles, std::uint32_t mostRemovals, OutwardScale scale,
             MetricFrame metric);

  const OutwardScale& scale() const { return scale_; }

  /// Announces removals. Thread-safe.
  /// @param linkSizes The sizes of their links, in order.
  /// @return The first; the others follow.
  RemovalId beginBatch(BatchOrder order, std::span<const std::uint8_t> linkSizes);
  /// The recorder id of the first floor triangle of a removal.
  RecorderId firstFloorTriangle(RemovalId removal) const {
    return RecorderId(finestTriangles_ + slotBegin_[removal.index()] - 2 * removal.index());
  }
  /// The number of slots (one per link vertex) of all removals before this one. Also of the number after
  /// that of the last removal of a batch.
  std::uint32_t firstSlot(RemovalId removal) const { return slotBegin_[removal.index()]; }
  /// The codes recorded of a triangle; zeros for triangles of the finest triangulation. Precondition: the
  /// removal that created it belongs to an earlier batch.
  FloorCodes codes(RecorderId triangle) const {
    return triangle.index() < finestTriangles_ ? FloorCodes{} : floor_[triangle.index() - finestTriangles_];
  }
  /// Records an announced removal: record() all of it but the saturated error and the sphere, which
  /// saturate() computes. Both are thread-safe for different removals of a batch. Preconditions: link.size()
  /// as announced, at least 3; the removals that created its ceiling belong to earlier batches, which are
  /// complete.
  void record(RemovalId removal, const VertexRemoval& what);
  void saturate(RemovalId removal, const VertexRemoval& what);

  /// Prefetches what saturate() and codes() read of a ceiling triangle and of the removal that created it.
  [[gnu::always_inline]] void prefetch(RemovalId creator, RecorderId triangle) const {
    if (!creator.isValid()) return;
    __builtin_prefetch(&saturated_[creator.index()]);
    __builtin_prefetch(&sphere_[creator.index()]);
    __builtin_prefetch(&floor_[triangle.index() - finestTriangles_]);
  }

  /// The finished MT, without vertex positions (MtArrays::vertices): the caller adds them by withVertices().
  /// Leaves the recorder empty. O(triangles), parallel; the result does not depend on the threads.
  /// @param rootVertices The surviving vertices, in the order that the MT gives them.
  /// @param surviving The surviving triangles.
  /// @param callerVertexCount All of the caller's vertex ids are below it.
  /// @param vertexOrder Receives the caller's vertex of every MT vertex.
  /// @param clock May be null (RunContext::clock).
  MultiTriangulation finish(std::span<const VertexId> rootVertices,
                            std::span<const SurvivingTriangle> surviving, std::uint32_t callerVertexCount,
                            UninitializedVector<std::uint32_t>& vertexOrder, StageClock* clock = nullptr);

 private:
  class Finishing;
  /// A slot without a triangle: the last one of an open star.
  static constexpr std::uint32_t kNone = MultiTriangulation::kNone;

  std::uint32_t finestTriangles_;
  OutwardScale scale_;
  MetricFrame metric_;

  struct Batch {
    BatchOrder order;
    std::uint32_t first, size;
  };
  std::mutex growing_;  // guards the size of everything below
  std::vector<Batch> batches_;
  std::uint32_t removals_ = 0;

  // Raw numbers from here on: finish() turns one kind into another in place.
  ChunkedArray<std::uint32_t> slotBegin_;  // per removal, and the end
  ChunkedArray<std::uint32_t> vertex_;     // per removal
  ChunkedArray<std::uint16_t> saturated_;  // per removal
  ChunkedArray<Sphere> sphere_;            // per removal
  ChunkedArray<std::uint32_t> link_;       // per slot
  ChunkedArray<std::uint32_t> ceiling_;    // per slot: recorder ids; kNone in the last slot of an open star
  ChunkedArray<FloorCodes> floor_;         // per floor triangle, in recorder order
};

/// The same MT with the given vertices.
/// @param owner Keeps the vertices alive, beside the MT's own owner.
MultiTriangulation withVertices(const MultiTriangulation& mt, const VertexArrays& vertices,
                                std::shared_ptr<const void> owner);

}  // namespace arete
