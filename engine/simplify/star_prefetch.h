// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/simplify/live_mesh.h"

namespace arete {

/// Asks for the stars of the next vertices of a list, on the visit of its i-th.
///
/// A walk around a star follows one pointer after the other. Asking early for what the next stars start with
/// hides most of the waiting: first the half-edge, then its triangle, then those on either side of it, then
/// those beyond. Only triangles of the stars are looked at: others may be at work on their neighbours.
/// (Always inlined, lambdas included: GCC 12 takes a function of nothing but prefetches for one without
/// effect and drops its calls.)
template <class VertexAt>
[[gnu::always_inline]] inline void prefetchStars(const LiveMesh& mesh, std::size_t i, std::size_t size,
                                                 const VertexAt& vertexAt) {
  constexpr std::size_t kFirst = 16, kSecond = 12, kThird = 8, kFourth = 4;
  constexpr std::uint32_t kNone = LiveMesh::kNone;
  const auto halfedge = [&](std::size_t k) { return mesh.vertexHalfedge[vertexAt(k)]; };
  const auto ask = [&](std::uint32_t h) __attribute__((always_inline)) {
    if (h != kNone) __builtin_prefetch(&mesh.triangles[LiveMesh::triangleOf(h)]);
  };
  if (i + kFirst < size) __builtin_prefetch(&mesh.vertexHalfedge[vertexAt(i + kFirst)]);
  if (i + kSecond < size) ask(halfedge(i + kSecond));
  // From one half-edge that leaves the vertex to the next one, either way.
  const auto after = [&](std::uint32_t h) {
    return h == kNone ? kNone : mesh.twinOf(LiveMesh::previousInTriangle(h));
  };
  const auto before = [&](std::uint32_t h) {
    const std::uint32_t twin = h == kNone ? kNone : mesh.twinOf(h);
    return twin == kNone ? kNone : LiveMesh::nextInTriangle(twin);
  };
  if (i + kThird < size) {
    const std::uint32_t h = halfedge(i + kThird);
    ask(after(h));
    ask(before(h));
  }
  if (i + kFourth < size) {
    const std::uint32_t h = halfedge(i + kFourth);
    ask(after(after(h)));
    ask(before(before(h)));
  }
}

}  // namespace arete
