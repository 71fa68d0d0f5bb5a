// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "terrain/live_mesh.h"

namespace arete {

/// How far ahead a star is asked for: `own` looks no further than its first triangle, which nobody else
/// rewrites while stars are being rewritten.
enum class StarReach { own, neighbours };

/// Asks for the stars of the next vertices of a list, on the visit of its i-th.
///
/// A walk around a star follows one pointer after the other. Asking early for what the next stars start with
/// hides most of the waiting: first the half-edge, then its triangle, then that one's neighbours. (Always
/// inlined: GCC 12 takes a function of nothing but prefetches for one without effect and drops its calls.)
template <StarReach reach, class VertexAt>
[[gnu::always_inline]] inline void prefetchStars(const LiveMesh& mesh, std::size_t i, std::size_t size,
                                                 const VertexAt& vertexAt) {
  constexpr std::size_t kFirst = 16, kSecond = 12, kThird = 8, kFourth = 4;
  constexpr std::uint32_t kNone = LiveMesh::kNone;
  if (i + kFirst < size) __builtin_prefetch(&mesh.vertexHalfedge[vertexAt(i + kFirst)]);
  if (i + kSecond < size)
    __builtin_prefetch(&mesh.triangles[LiveMesh::triangleOf(mesh.vertexHalfedge[vertexAt(i + kSecond)])]);
  if (i + kThird < size)
    for (const std::uint32_t h :
         mesh.triangles[LiveMesh::triangleOf(mesh.vertexHalfedge[vertexAt(i + kThird)])].twin)
      if (h != kNone) __builtin_prefetch(&mesh.triangles[LiveMesh::triangleOf(h)]);
  if (reach == StarReach::neighbours && i + kFourth < size)
    for (const std::uint32_t h :
         mesh.triangles[LiveMesh::triangleOf(mesh.vertexHalfedge[vertexAt(i + kFourth)])].twin)
      if (h != kNone)
        for (const std::uint32_t g : mesh.triangles[LiveMesh::triangleOf(h)].twin)
          if (g != kNone) __builtin_prefetch(&mesh.triangles[LiveMesh::triangleOf(g)]);
}

}  // namespace arete
