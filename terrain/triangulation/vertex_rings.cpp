// SPDX-License-Identifier: GPL-3.0-or-later
//
// Compressed rows: one walk around every vertex counts its neighbours, a prefix sum turns the counts into
// offsets, a second walk writes the neighbours.
#include "terrain/triangulation/vertex_rings.h"

#include <cstddef>
#include <utility>

#include "engine/parallel/parallel_loops.h"

namespace arete {
namespace {

template <class Visit>
void forVertices(const LiveMesh& mesh, const Visit& visit) {
  parallelFor(IndexRange<std::size_t>(0, mesh.vertexCount(), 1 << 13), [&](const auto& range) {
    for (std::size_t v = range.begin(); v != range.end(); ++v)
      if (const VertexId id(static_cast<std::uint32_t>(v)); mesh.isInTriangle(id)) visit(id);
  });
}

/// visit(u) for the neighbours of a vertex and, if it is on a border, for an invalid one.
template <class Visit>
void forRing(const LiveMesh& mesh, VertexId v, const Visit& visit) {
  const HalfedgeId first = mesh.vertexHalfedge[v];
  HalfedgeId h = first;
  do {
    visit(mesh.origin(LiveMesh::nextInTriangle(h)));
    const HalfedgeId last = LiveMesh::previousInTriangle(h);
    h = mesh.twinOf(last);
    if (!h.isValid()) visit(mesh.origin(last));
  } while (h.isValid() && h != first);
  if (!h.isValid()) visit(VertexId());
}

}  // namespace

VertexRings::VertexRings(const LiveMesh& mesh) {
  const std::size_t vertices = mesh.vertexCount();
  begin_.assign(vertices + 1, 0);
  forVertices(mesh, [&](VertexId v) { forRing(mesh, v, [&](VertexId) { ++begin_[v.index()]; }); });
  std::uint32_t next = 0;
  for (std::uint32_t& begin : begin_) next += std::exchange(begin, next);
  neighbours_.resize(next);
  forVertices(mesh, [&](VertexId v) {
    VertexId* to = neighbours_.data() + begin_[v.index()];
    forRing(mesh, v, [&](VertexId u) { *to++ = u; });
  });
}

}  // namespace arete
