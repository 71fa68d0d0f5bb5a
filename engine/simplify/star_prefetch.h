// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/simplify/live_mesh.h"

namespace arete {

/// Prefetches the stars of the next vertices of a list, on the visit of its i-th.
///
/// A walk around a star follows one reference after the other. Prefetching in stages hides most of the memory
/// latency: 16 vertices ahead the half-edge of the vertex, 12 ahead its triangle, 8 ahead the triangles on
/// either side of that one, 4 ahead those beyond. It reads triangles of the stars only: other threads may be
/// rewriting the neighbours. (Always inlined, lambdas included: GCC 12 takes a function of nothing but
/// prefetches for one without effect and drops its calls.)
template <class VertexAt>
[[gnu::always_inline]] inline void prefetchStars(const LiveMesh& mesh, std::size_t i, std::size_t size,
                                                 const VertexAt& vertexAt) {
  constexpr std::size_t kFirst = 16, kSecond = 12, kThird = 8, kFourth = 4;
  const auto halfedge = [&](std::size_t k) { return mesh.vertexHalfedge[vertexAt(k)]; };
  const auto prefetch = [&](HalfedgeId h) __attribute__((always_inline)) {
    if (h.isValid()) __builtin_prefetch(&mesh.triangles[LiveMesh::slotOf(h)]);
  };
  if (i + kFirst < size) __builtin_prefetch(&mesh.vertexHalfedge[vertexAt(i + kFirst)]);
  if (i + kSecond < size) prefetch(halfedge(i + kSecond));
  // From one half-edge that leaves the vertex to the next one, either way.
  const auto after = [&](HalfedgeId h) {
    return h.isValid() ? mesh.twinOf(LiveMesh::previousInTriangle(h)) : HalfedgeId();
  };
  const auto before = [&](HalfedgeId h) {
    const HalfedgeId twin = h.isValid() ? mesh.twinOf(h) : HalfedgeId();
    return twin.isValid() ? LiveMesh::nextInTriangle(twin) : HalfedgeId();
  };
  if (i + kThird < size) {
    const HalfedgeId h = halfedge(i + kThird);
    prefetch(after(h));
    prefetch(before(h));
  }
  if (i + kFourth < size) {
    const HalfedgeId h = halfedge(i + kFourth);
    prefetch(after(after(h)));
    prefetch(before(before(h)));
  }
}

}  // namespace arete
