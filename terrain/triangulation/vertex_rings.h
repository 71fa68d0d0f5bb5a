// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/memory/uninitialized_vector.h"
#include "engine/simplify/live_mesh.h"

namespace arete {

/// A triangulation by the neighbours of its vertices, for walks that cross it: 28 bytes a vertex, and all
/// that is around one lies together.
class VertexRings {
 public:
  static constexpr std::uint32_t kNone = LiveMesh::kNone;

  /// O(vertices), parallel. Precondition: the triangles of each vertex form one fan, or it is passed by no
  /// walk; there are fewer than 2^31 edges, each of which is in two rings.
  explicit VertexRings(const LiveMesh& mesh);

  /// Of a vertex its neighbours, counter-clockwise; of one on a border kNone after the last. Empty where it
  /// is in no triangle.
  std::span<const std::uint32_t> of(std::uint32_t vertex) const {
    return {neighbours_.data() + begin_[vertex], neighbours_.data() + begin_[vertex + 1]};
  }

  /// Asks for the ring of a vertex.
  [[gnu::always_inline]] void prefetch(std::uint32_t vertex) const {
    __builtin_prefetch(neighbours_.data() + begin_[vertex]);
  }

 private:
  UninitializedVector<std::uint32_t> begin_;       // per vertex, and the end
  UninitializedVector<std::uint32_t> neighbours_;  // by vertex
};

/// A vertex and where one of its neighbours stands in its ring.
class RingPlace {
 public:
  /// Precondition: the two are neighbours.
  RingPlace(const VertexRings& rings, std::uint32_t vertex, std::uint32_t neighbour)
      : ring_(rings.of(vertex)), place_(0) {
    while (ring_[place_] != neighbour) ++place_;
  }
  /// The neighbour after it, counter-clockwise, kNone where there is a border between the two.
  std::uint32_t next() {
    place_ = place_ + 1 < ring_.size() ? place_ + 1 : 0;
    return ring_[place_];
  }
  /// The one before it.
  std::uint32_t previous() {
    place_ = (place_ > 0 ? place_ : ring_.size()) - 1;
    return ring_[place_];
  }

 private:
  std::span<const std::uint32_t> ring_;
  std::size_t place_;
};

}  // namespace arete
