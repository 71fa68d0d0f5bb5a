// SPDX-License-Identifier: GPL-3.0-or-later
//
// The removals of a batch are independent: no two stars share a triangle. Two stars may share an edge of
// their rims. If one thread rewrites the stars one after the other, each is joined to its neighbours at once
// (sewAlone()). If several threads rewrite stars at a time, a thread could read a neighbour that another one
// has half rewritten; so a batch has two steps with a barrier between. refill() rewrites the slots of a star
// and records in its seams to which half-edge each rim edge has moved. sew() then joins each rim edge to its
// former twin; if that twin's slot was rewritten too, the seams of that removal say where the twin is now. An
// edge between two moved stars is written from both sides, each side its own twin; an unmoved twin has one
// moved neighbour across its edge. So no location is written twice.
#include "engine/simplify/live_mesh.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>

#include "engine/base/branchless.h"
#include "engine/parallel/parallel_filter.h"
#include "engine/parallel/parallel_loops.h"

namespace arete {

LiveMesh LiveMesh::fromTriangles(std::vector<std::array<std::uint32_t, 3>> corners, std::uint32_t vertexCount,
                                 std::vector<VertexId>& pinched) {
  LiveMesh mesh;
  const std::size_t count = corners.size();
  assert(count <= kMostTriangles);
  mesh.triangles = decltype(mesh.triangles)(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    const auto [a, b, c] = corners[t];
    mesh.triangles[SlotId(t)] = {{VertexId(a), VertexId(b), VertexId(c)}, {}, RecorderId(t), RemovalId()};
  }
  std::vector<std::array<std::uint32_t, 3>>().swap(corners);
  mesh.vertexHalfedge = decltype(mesh.vertexHalfedge)(vertexCount);
  std::fill(mesh.vertexHalfedge.begin(), mesh.vertexHalfedge.end(), HalfedgeId());

  // A linked list of outgoing half-edges per vertex: each twin is found among the few edges at one end.
  IdArray<HalfedgeId, std::vector<HalfedgeId>> nextOutgoing(count * 4);
  IdArray<VertexId, std::vector<std::uint8_t>> degree(vertexCount, std::uint8_t(0));
  for (std::uint32_t t = 0; t < count; ++t) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const HalfedgeId h = halfedge(SlotId(t), i);
      const VertexId v = mesh.origin(h);
      nextOutgoing[h] = mesh.vertexHalfedge[v];
      mesh.vertexHalfedge[v] = h;
      if (degree[v] < 255) ++degree[v];
    }
  }
  for (std::uint32_t i = 0; i < 4 * count; ++i) {
    const HalfedgeId h(i);
    if (sideOf(h) == 3 || mesh.twinOf(h).isValid()) continue;
    const VertexId from = mesh.origin(h), to = mesh.origin(nextInTriangle(h));
    // The twin leaves `to`, and the half-edge after it leaves `from`: the end with fewer edges is searched.
    const bool isAtEnd = degree[to] <= degree[from];
    for (HalfedgeId g = mesh.vertexHalfedge[isAtEnd ? to : from]; g.isValid(); g = nextOutgoing[g]) {
      const HalfedgeId twin = isAtEnd ? g : previousInTriangle(g);
      if (mesh.origin(isAtEnd ? nextInTriangle(g) : twin) != (isAtEnd ? from : to)) continue;
      mesh.setTwin(h, twin);
      mesh.setTwin(twin, h);
      break;
    }
  }
  // A vertex on the border keeps the half-edge with which its fan begins, so that one turn visits the whole
  // fan. A vertex whose fan has fewer triangles than the vertex is in has several fans: it is pinched.
  for (std::uint32_t i = 0; i < vertexCount; ++i) {
    const VertexId v(i);
    if (!mesh.isInTriangle(v)) continue;
    for (HalfedgeId g = mesh.vertexHalfedge[v]; g.isValid(); g = nextOutgoing[g])
      if (!mesh.twinOf(g).isValid()) {
        mesh.vertexHalfedge[v] = g;
        break;
      }
    unsigned fan = 0;
    HalfedgeId h = mesh.vertexHalfedge[v];
    do {
      ++fan;
      h = mesh.twinOf(previousInTriangle(h));
    } while (h.isValid() && h != mesh.vertexHalfedge[v]);
    if (std::min(fan, 255u) != degree[v]) pinched.push_back(v);
  }
  return mesh;
}

// Slots keep their order, so the result does not depend on threads. Half-edges name slots, and are renamed
// with them.
SlotMap LiveMesh::compact(std::span<const VertexId> vertices) {
  SlotMap newSlot(triangles.size(), [&](SlotId slot) { return !triangles[slot].isDead(); });
  const auto moved = [&](HalfedgeId h) {
    return h.isValid() ? halfedge(newSlot.ofLive(slotOf(h)), sideOf(h)) : HalfedgeId();
  };
  newSlot.forLiveInPlace([&](SlotId from, SlotId to) {
    const Triangle triangle = triangles[from];
    triangles[to] = {triangle.corners,
                     {moved(triangle.twin[0]), moved(triangle.twin[1]), moved(triangle.twin[2])},
                     triangle.recorderId,
                     triangle.creator};
  });
  triangles.shrink(newSlot.liveCount());
  parallelFor(IndexRange<std::size_t>(0, vertices.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      if (vertices[i].isValid()) vertexHalfedge[vertices[i]] = moved(vertexHalfedge[vertices[i]]);
  });
  return newSlot;
}

/// Each vertex is written at the slot of its own half-edge, so each is listed once and in the order of the
/// slots.
UninitializedVector<VertexId> LiveMesh::verticesInOrder() const {
  UninitializedVector<VertexId> inOrder;
  ParallelFilter<VertexId> halfedges;
  halfedges(4 * triangles.size(), 1 << 16, inOrder, [&](std::size_t begin, std::size_t end, VertexId* to) {
    for (std::size_t t = begin / 4; t != end / 4; ++t) {
      const SlotId slot(static_cast<std::uint32_t>(t));
      if (triangles[slot].isDead()) continue;
      for (std::uint32_t side = 0; side < 3; ++side) {
        const VertexId v = triangles[slot].corners[side];
        if (vertexHalfedge[v] == halfedge(slot, side)) *to++ = v;
      }
    }
    return to;
  });
  return inOrder;
}

bool Star::gather(const LiveMesh& mesh, VertexId v, int maxLink) {
  const HalfedgeId first = mesh.vertexHalfedge[v];
  if (!first.isValid()) return false;
  isOpen = false;
  constexpr std::array<std::uint8_t, 3> kNext{1, 2, 0}, kPrevious{2, 0, 1};  // sides of a triangle
  int count = 0;
  HalfedgeId h = first;
  do {
    if (count >= maxLink) return false;
    const LiveMesh::Triangle& triangle = mesh.triangles[LiveMesh::slotOf(h)];
    const std::uint32_t side = LiveMesh::sideOf(h), last = kPrevious[side];
    link[count] = triangle.corners[kNext[side]];
    outgoing[count] = h;
    ++count;
    h = triangle.twin[last];
    if (!h.isValid()) {
      if (count >= maxLink) return false;
      link[count] = triangle.corners[last];
      linkSize = count + 1;
      triangleCount = count;
      isOpen = true;
      return true;
    }
  } while (h != first);
  linkSize = triangleCount = count;
  return true;
}

void refill(LiveMesh& mesh, const Star& star, const HoleTriangulation& floor, const FloorJoins& joins,
            RecorderId firstId, RemovalId removal, std::span<Seam> seams) {
  const int corners = star.linkSize;
  assert(floor.size == corners - 2 && seams.size() == static_cast<std::size_t>(corners));
  const auto halfedge = [&](FloorJoins::Side s) { return LiveMesh::halfedge(star.slot(s.triangle), s.side); };

  SlotId before = star.isOpen ? SlotId() : star.slot(corners - 1);
  for (int i = 0; i < corners; ++i) {
    const bool isClosing = i == star.triangleCount;  // the new border edge of an open star
    const HalfedgeId rim = isClosing ? HalfedgeId() : star.rim(i);
    const SlotId own = isClosing ? SlotId() : star.slot(i);
    seams[i] = {rim, halfedge(joins.rim[i]), isClosing ? HalfedgeId() : mesh.twinOf(rim)};
    // About a third of the link's vertices refer to a half-edge of this star, which is rewritten. Another
    // thread may be changing the same reference to a half-edge of its own star: neither its old nor its new
    // value is of this star then.
    HalfedgeId& reference = mesh.vertexHalfedge[star.link[i]];
    const SlotId t = LiveMesh::slotOf(std::atomic_ref(reference).load(std::memory_order_relaxed));
    storeIf((t == own) | (t == before), reference, seams[i].movedTo);
    before = own;
  }

  for (int d = 0; d < joins.diagonalCount; ++d) {
    const HalfedgeId forth = halfedge(joins.diagonals[d].forth), back = halfedge(joins.diagonals[d].back);
    mesh.setTwin(forth, back);
    mesh.setTwin(back, forth);
  }
  for (int f = 0; f < floor.size; ++f) {
    const auto& local = floor.triangles[f];
    LiveMesh::Triangle& triangle = mesh.triangles[star.slot(f)];
    triangle.corners = {star.link[local[0]], star.link[local[1]], star.link[local[2]]};
    triangle.recorderId = RecorderId(firstId.index() + static_cast<std::uint32_t>(f));
    triangle.creator = removal;
  }
  for (int i = floor.size; i < star.triangleCount; ++i) {
    mesh.triangles[star.slot(i)].corners[0] = VertexId();
    mesh.triangles[star.slot(i)].creator = removal;
  }
}

}  // namespace arete
