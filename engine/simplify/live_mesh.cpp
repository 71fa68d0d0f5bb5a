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

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>

#include "engine/base/branchless.h"
#include "engine/parallel/parallel_filter.h"

namespace arete {

LiveMesh LiveMesh::fromTriangles(std::vector<Corners> corners, std::uint32_t vertexCount,
                                 std::vector<std::uint32_t>& pinched) {
  LiveMesh mesh;
  const std::size_t count = corners.size();
  assert(count <= kMostTriangles);
  mesh.triangles = PagedArray<Triangle>(count);
  for (std::uint32_t t = 0; t < count; ++t) mesh.triangles[t] = {corners[t], {}, t, kNone};
  std::vector<Corners>().swap(corners);
  mesh.vertexHalfedge = PagedArray<HalfedgeId>(vertexCount);
  std::fill(mesh.vertexHalfedge.begin(), mesh.vertexHalfedge.end(), HalfedgeId());

  // A linked list of outgoing half-edges per vertex: each twin is found among the few edges at one end.
  std::vector<HalfedgeId> nextOutgoing(count * 4);
  std::vector<std::uint8_t> degree(vertexCount, 0);
  for (std::uint32_t t = 0; t < count; ++t) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t v = mesh.triangles[t].corners[i];
      nextOutgoing[halfedge(t, i).index()] = mesh.vertexHalfedge[v];
      mesh.vertexHalfedge[v] = halfedge(t, i);
      if (degree[v] < 255) ++degree[v];
    }
  }
  for (std::uint32_t i = 0; i < 4 * count; ++i) {
    const HalfedgeId h(i);
    if (sideOf(h) == 3 || mesh.twinOf(h).isValid()) continue;
    const std::uint32_t from = mesh.origin(h), to = mesh.origin(nextInTriangle(h));
    // The twin leaves `to`, and the half-edge after it leaves `from`: the end with fewer edges is searched.
    const bool isAtEnd = degree[to] <= degree[from];
    for (HalfedgeId g = mesh.vertexHalfedge[isAtEnd ? to : from]; g.isValid(); g = nextOutgoing[g.index()]) {
      const HalfedgeId twin = isAtEnd ? g : previousInTriangle(g);
      if (mesh.origin(isAtEnd ? nextInTriangle(g) : twin) != (isAtEnd ? from : to)) continue;
      mesh.setTwin(h, twin);
      mesh.setTwin(twin, h);
      break;
    }
  }
  for (std::uint32_t v = 0; v < vertexCount; ++v) {
    if (!mesh.isInTriangle(v)) continue;
    for (HalfedgeId g = mesh.vertexHalfedge[v]; g.isValid(); g = nextOutgoing[g.index()])
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

SlotMap LiveMesh::compact(std::span<const std::uint32_t> vertices) {
  SlotMap newSlot(triangles.size(), [&](std::size_t t) { return !triangles[t].isDead(); });
  const auto moved = [&](HalfedgeId h) {
    return h.isValid() ? halfedge(newSlot.ofLive(slotOf(h)), sideOf(h)) : HalfedgeId();
  };
  newSlot.forLiveInPlace([&](std::size_t from, std::uint32_t to) {
    const Triangle triangle = triangles[from];
    triangles[to] = {triangle.corners,
                     {moved(triangle.twin[0]), moved(triangle.twin[1]), moved(triangle.twin[2])},
                     triangle.recorderId,
                     triangle.creator};
  });
  triangles.shrink(newSlot.liveCount());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, vertices.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      if (vertices[i] != kNone) vertexHalfedge[vertices[i]] = moved(vertexHalfedge[vertices[i]]);
  });
  return newSlot;
}

UninitializedVector<std::uint32_t> LiveMesh::verticesInOrder() const {
  UninitializedVector<std::uint32_t> inOrder;
  ParallelFilter<std::uint32_t> halfedges;
  halfedges(4 * triangles.size(), 1 << 16, inOrder,
            [&](std::size_t begin, std::size_t end, std::uint32_t* to) {
              for (std::size_t t = begin / 4; t != end / 4; ++t) {
                if (triangles[t].isDead()) continue;
                for (std::uint32_t side = 0; side < 3; ++side) {
                  const std::uint32_t v = triangles[t].corners[side];
                  if (vertexHalfedge[v] == halfedge(static_cast<std::uint32_t>(t), side)) *to++ = v;
                }
              }
              return to;
            });
  return inOrder;
}

bool Star::gather(const LiveMesh& mesh, std::uint32_t v, int maxLink) {
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
            std::uint32_t firstId, std::uint32_t removal, std::span<Seam> seams) {
  const int corners = star.linkSize;
  assert(floor.size == corners - 2 && seams.size() == static_cast<std::size_t>(corners));
  const auto halfedge = [&](FloorJoins::Side s) { return LiveMesh::halfedge(star.slot(s.triangle), s.side); };

  std::uint32_t before = star.isOpen ? LiveMesh::kNone : star.slot(corners - 1);
  for (int i = 0; i < corners; ++i) {
    const bool isClosing = i == star.triangleCount;  // the new border edge of an open star
    const HalfedgeId rim = isClosing ? HalfedgeId() : star.rim(i);
    const std::uint32_t own = isClosing ? LiveMesh::kNone : star.slot(i);
    seams[i] = {rim, halfedge(joins.rim[i]), isClosing ? HalfedgeId() : mesh.twinOf(rim)};
    // About a third of the link's vertices refer to a half-edge of this star, which is rewritten. Another
    // thread may be changing the same reference to a half-edge of its own star: neither its old nor its new
    // value is of this star then.
    HalfedgeId& reference = mesh.vertexHalfedge[star.link[i]];
    const std::uint32_t t = LiveMesh::slotOf(std::atomic_ref(reference).load(std::memory_order_relaxed));
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
    triangle.recorderId = firstId + static_cast<std::uint32_t>(f);
    triangle.creator = removal;
  }
  for (int i = floor.size; i < star.triangleCount; ++i) {
    mesh.triangles[star.slot(i)].corners[0] = LiveMesh::kNone;
    mesh.triangles[star.slot(i)].creator = removal;
  }
}

}  // namespace arete
