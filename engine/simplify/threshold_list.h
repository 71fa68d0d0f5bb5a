// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/base/branchless.h"
#include "engine/base/id_array.h"
#include "engine/base/ids.h"
#include "engine/memory/uninitialized_vector.h"
#include "engine/parallel/loop_threads.h"
#include "engine/parallel/parallel_filter.h"

namespace arete {

/// The vertices of a triangulation that shrinks, each with a threshold. A vertex is *due* in a level whose
/// threshold is at least its own.
///
/// A level scans all of them for the few that are due; so the thresholds are contiguous, in the order of the
/// vertices along the ground, and a vertex finds its threshold by its index. Removed vertices keep their
/// index (threshold = infinity) until compact(). Fixed vertices have an index too, with an infinite
/// threshold.
class ThresholdList {
 public:
  static constexpr float kNow = 0;  ///< due in every level
  static constexpr float kNever = std::numeric_limits<float>::infinity();

  /// Indices from `begin` to before `end`: a tile of the ground.
  struct Tile {
    std::uint32_t begin = 0, end = 0;
    std::uint32_t size() const { return end - begin; }
  };

  /// Scratch memory of collect().
  using Scratch = ParallelFilter<VertexId>;

  /// Replaces the list. All vertices that are not fixed are due now. O(vertices), parallel.
  /// @param vertices in the order in which levels visit them, fixed ones included.
  /// @param isFixed per vertex, not 0 = yes.
  void assign(std::span<const VertexId> vertices, std::span<const std::uint8_t> isFixed);

  /// The number of vertices that are neither fixed nor removed.
  std::size_t size() const { return removable_; }
  bool empty() const { return size() == 0; }

  /// All indices.
  Tile all() const { return {kNoIndex + 1, static_cast<std::uint32_t>(vertices_.size())}; }
  /// Whether the index of v lies in the tile. Precondition: v is not removed.
  bool isWithin(Tile tile, VertexId v) const { return index_[v] - tile.begin < tile.size(); }
  /// The vertex of each index of all(), in order; invalid if it is removed.
  std::span<const VertexId> vertices() const { return std::span(vertices_).subspan(kNoIndex + 1); }
  /// The index of v, the same until compact(). Precondition: v is not removed.
  std::uint32_t indexOf(VertexId v) const { return index_[v]; }
  /// Drops the removed vertices if they are more than half: indices change. O(size), parallel.
  void compact();

  /// `due` receives the vertices that are due at a threshold, in order. O(indices), parallel.
  void collect(double threshold, std::vector<VertexId>& due, Scratch& scratch) const;
  /// The same of the vertices of a tile, on the calling thread. O(size of the tile).
  void collect(Tile tile, double threshold, UninitializedVector<VertexId>& due) const;
  /// The same of `some` vertices; removed ones are never due. O(some), parallel.
  void collect(std::span<const VertexId> some, double threshold, std::vector<VertexId>& due,
               Scratch& scratch) const;

  /// Sets the threshold of v. Thread-safe for vertices that are in the list; for the same vertex one of the
  /// thresholds stays. No effect if v is removed or not in the list, as for makeDueIf().
  void set(VertexId v, float threshold) {
    std::atomic_ref(thresholds_[index_[v]]).store(threshold, std::memory_order_relaxed);
  }
  /// Makes v due now if the condition holds, without a branch. Thread-safe, for the same vertex too, but not
  /// beside set() of the same vertex.
  void makeDueIf(bool condition, VertexId v) { storeIf(condition, thresholds_[index_[v]], kNow); }
  /// Removes vertices from the list. Thread-safe for different vertices. O(removed).
  void remove(std::span<const VertexId> removed, LoopThreads threads);
  /// Sorts vertices by their indices and drops repeats. Precondition: none is removed.
  void sort(std::vector<VertexId>& vertices) const;

  /// The least threshold; kNever if no vertex will be due. O(size).
  float least() const;

  /// The threshold at which about a given fraction of the vertices with a finite threshold are due, estimated
  /// from a sample of a thousand; kNow if there are fewer than 64. O(sample).
  /// Precondition: 0 <= fraction < 1.
  float quantile(double fraction) const;

  /// Prefetches what set() and makeDueIf() read.
  [[gnu::always_inline]] void prefetch(VertexId v) const { __builtin_prefetch(&index_[v]); }

 private:
  /// Writes the vertices of some indices that are due to `to`, which has room for all of them.
  /// @return the end of what was written.
  VertexId* collectTo(std::size_t begin, std::size_t end, double threshold, VertexId* to) const;

  static constexpr std::uint32_t kNoIndex = 0;  // shared by all vertices that are not in the list; never read
  UninitializedVector<VertexId> vertices_;      // by index; invalid if removed
  UninitializedVector<float> thresholds_;       // by index
  IdArray<VertexId, UninitializedVector<std::uint32_t>> index_;
  std::atomic<std::size_t> removable_ = 0;
  std::size_t fixed_ = 0;
};

}  // namespace arete
