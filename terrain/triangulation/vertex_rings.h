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
  /// O(vertices), parallel. Preconditions: the triangles of each vertex that a walk visits form one fan;
  /// there are fewer than 2^31 edges (each is in two rings).
  explicit VertexRings(const LiveMesh& mesh);

  /// The neighbours of a vertex, counter-clockwise; an invalid one after the last if the vertex is on a
  /// border. Empty if it is in no triangle.
  std::span<const VertexId> of(VertexId vertex) const {
    return {neighbours_.data() + begin_[vertex.index()], neighbours_.data() + begin_[vertex.index() + 1]};
  }

  /// Prefetches the ring of a vertex.
  [[gnu::always_inline]] void prefetch(VertexId vertex) const {
    __builtin_prefetch(neighbours_.data() + begin_[vertex.index()]);
  }

 private:
  UninitializedVector<std::uint32_t> begin_;  // per vertex, and the end
  UninitializedVector<VertexId> neighbours_;  // by vertex
};

/// A position in the ring of a vertex, at one of its neighbours.
class RingPlace {
 public:
  /// Precondition: the two are neighbours.
  RingPlace(const VertexRings& rings, VertexId vertex, VertexId neighbour)
      : ring_(rings.of(vertex)), index_(0) {
    while (ring_[index_] != neighbour) ++index_;
  }
  /// Moves to the next neighbour, counter-clockwise; invalid if a border lies between the two.
  VertexId next() {
    index_ = index_ + 1 < ring_.size() ? index_ + 1 : 0;
    return ring_[index_];
  }
  /// Moves to the previous neighbour; invalid if a border lies between the two.
  VertexId previous() {
    index_ = (index_ > 0 ? index_ : ring_.size()) - 1;
    return ring_[index_];
  }

 private:
  std::span<const VertexId> ring_;
  std::size_t index_;
};

}  // namespace arete
