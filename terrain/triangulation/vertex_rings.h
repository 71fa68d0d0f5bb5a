// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/memory/uninitialized_vector.h"
#include "engine/simplify/live_mesh.h"

namespace arete {

/// A triangulation as the neighbours of each vertex, for walks that cross it: 28 bytes a vertex; the
/// neighbours of a vertex are contiguous in memory.
class VertexRings {
 public:
  static constexpr std::uint32_t kNone = LiveMesh::kNone;

  /// O(vertices), parallel. Preconditions: the triangles of each vertex that a walk visits form one fan;
  /// there are fewer than 2^31 edges (each is in two rings).
  explicit VertexRings(const LiveMesh& mesh);

  /// The neighbours of a vertex, counter-clockwise; kNone after the last if the vertex is on a border. Empty
  /// if it is in no triangle.
  std::span<const std::uint32_t> of(std::uint32_t vertex) const {
    return {neighbours_.data() + begin_[vertex], neighbours_.data() + begin_[vertex + 1]};
  }

  /// Prefetches the ring of a vertex.
  [[gnu::always_inline]] void prefetch(std::uint32_t vertex) const {
    __builtin_prefetch(neighbours_.data() + begin_[vertex]);
  }

 private:
  UninitializedVector<std::uint32_t> begin_;       // per vertex, and the end
  UninitializedVector<std::uint32_t> neighbours_;  // by vertex
};

/// A position in the ring of a vertex, at one of its neighbours.
class RingPlace {
 public:
  /// Precondition: the two are neighbours.
  RingPlace(const VertexRings& rings, std::uint32_t vertex, std::uint32_t neighbour)
      : ring_(rings.of(vertex)), index_(0) {
    while (ring_[index_] != neighbour) ++index_;
  }
  /// Moves to the next neighbour, counter-clockwise; kNone if a border lies between the two.
  std::uint32_t next() {
    index_ = index_ + 1 < ring_.size() ? index_ + 1 : 0;
    return ring_[index_];
  }
  /// Moves to the previous neighbour, or kNone.
  std::uint32_t previous() {
    index_ = (index_ > 0 ? index_ : ring_.size()) - 1;
    return ring_[index_];
  }

 private:
  std::span<const std::uint32_t> ring_;
  std::size_t index_;
};

}  // namespace arete
