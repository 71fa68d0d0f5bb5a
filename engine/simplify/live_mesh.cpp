// SPDX-License-Identifier: GPL-3.0-or-later
//
// Removals of a batch are independent: no two stars share a triangle. They may share an edge of their rims:
// where one is rewritten after the other, each is joined to its neighbours at once (sewAlone()). Threads that
// rewrite both at a time would each meet half a neighbour; so a batch of theirs works in two steps with a
// barrier between: refill() rewrites the slots of one star and notes where each rim half-edge went; sew()
// then joins each rim edge to its former twin, looking among the notes of the removal that rewrote that
// twin's slot if it moved too. Both sides of an edge between two moved stars write their own twin only, and
// an unmoved twin has one moved neighbour across that edge, so no location is written twice.
#include "engine/simplify/live_mesh.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>

#include "engine/parallel/parallel_filter.h"

namespace arete {

LiveMesh LiveMesh::fromTriangles(std::vector<Corners> corners, std::uint32_t vertexCount,
                                 std::vector<std::uint32_t>& pinched) {
  LiveMesh mesh;
  const std::size_t count = corners.size();
  assert(count <= kMostTriangles);
  mesh.triangles = PagedArray<Triangle>(count);
  for (std::uint32_t t = 0; t < count; ++t) mesh.triangles[t] = {corners[t], {kNone, kNone, kNone}, t, kNone};
  std::vector<Corners>().swap(corners);
  mesh.vertexHalfedge.assign(vertexCount, kNone);

  // Chains of outgoing half-edges per vertex find each twin among the few edges that leave one of its ends.
  std::vector<std::uint32_t> nextOutgoing(count * 4);
  std::vector<std::uint8_t> degree(vertexCount, 0);
  for (std::uint32_t t = 0; t < count; ++t) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t v = mesh.triangles[t].corners[i];
      nextOutgoing[halfedge(t, i)] = mesh.vertexHalfedge[v];
      mesh.vertexHalfedge[v] = halfedge(t, i);
      if (degree[v] < 255) ++degree[v];
    }
  }
  for (std::uint32_t h = 0; h < 4 * count; ++h) {
    if (sideOf(h) == 3 || mesh.twinOf(h) != kNone) continue;
    const std::uint32_t from = mesh.origin(h), to = mesh.origin(nextInTriangle(h));
    // The twin leaves `to`, and the half-edge after it leaves `from`: the one with fewer of them is asked.
    const bool isAskedAtEnd = degree[to] <= degree[from];
    for (std::uint32_t g = mesh.vertexHalfedge[isAskedAtEnd ? to : from]; g != kNone; g = nextOutgoing[g]) {
      const std::uint32_t twin = isAskedAtEnd ? g : previousInTriangle(g);
      if (mesh.origin(isAskedAtEnd ? nextInTriangle(g) : twin) != (isAskedAtEnd ? from : to)) continue;
      mesh.setTwin(h, twin);
      mesh.setTwin(twin, h);
      break;
    }
  }
  for (std::uint32_t v = 0; v < vertexCount; ++v) {
    if (mesh.vertexHalfedge[v] == kNone) continue;
    for (std::uint32_t g = mesh.vertexHalfedge[v]; g != kNone; g = nextOutgoing[g])
      if (mesh.twinOf(g) == kNone) {
        mesh.vertexHalfedge[v] = g;
        break;
      }
    unsigned fan = 0;
    std::uint32_t h = mesh.vertexHalfedge[v];
    do {
      ++fan;
      h = mesh.twinOf(previousInTriangle(h));
    } while (h != kNone && h != mesh.vertexHalfedge[v]);
    if (std::min(fan, 255u) != degree[v]) pinched.push_back(v);
  }
  return mesh;
}

SlotMap LiveMesh::compact(std::span<const std::uint32_t> vertices) {
  SlotMap newSlot(triangles.size(), [&](std::size_t t) { return !triangles[t].isDead(); });
  const auto moved = [&](std::uint32_t h) {
    return h == kNone ? kNone : halfedge(newSlot.ofLive(triangleOf(h)), sideOf(h));
  };
  newSlot.forLiveInPlace([&](std::size_t from, std::uint32_t to) {
    const Triangle triangle = triangles[from];
    triangles[to] = {triangle.corners,
                     {moved(triangle.twin[0]), moved(triangle.twin[1]), moved(triangle.twin[2])},
                     triangle.birth,
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
  const std::uint32_t first = mesh.vertexHalfedge[v];
  if (first == LiveMesh::kNone) return false;
  isOpen = false;
  constexpr std::array<std::uint8_t, 3> kNext{1, 2, 0}, kPrevious{2, 0, 1};  // sides of a triangle
  int count = 0;
  std::uint32_t h = first;
  do {
    if (count >= maxLink) return false;
    const LiveMesh::Triangle& triangle = mesh.triangles[LiveMesh::triangleOf(h)];
    const std::uint32_t side = LiveMesh::sideOf(h), last = kPrevious[side];
    link[count] = triangle.corners[kNext[side]];
    outgoing[count] = h;
    ++count;
    h = triangle.twin[last];
    if (h == LiveMesh::kNone) {
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
            std::uint32_t firstBirth, std::uint32_t removal, std::span<Seam> seams) {
  const int corners = star.linkSize;
  assert(floor.size == corners - 2 && seams.size() == static_cast<std::size_t>(corners));
  const auto halfedge = [&](FloorJoins::Side s) {
    return LiveMesh::halfedge(star.triangle(s.triangle), s.side);
  };

  std::uint32_t before = star.isOpen ? LiveMesh::kNone : star.triangle(corners - 1);
  for (int i = 0; i < corners; ++i) {
    const bool isClosing = i == star.triangleCount;  // the new border edge of an open star
    const std::uint32_t rim = isClosing ? LiveMesh::kNone : star.rim(i),
                        own = isClosing ? LiveMesh::kNone : star.triangle(i);
    seams[i] = {rim, halfedge(joins.rim[i]), isClosing ? LiveMesh::kNone : mesh.twinOf(rim)};
    // A vertex of the link may point at a half-edge that is about to vanish. Another star of the batch may be
    // re-pointing it within its own slots: either value is not of this star. A third of them must point
    // elsewhere, nobody foresees which: the others write beside.
    std::uint32_t& pointer = mesh.vertexHalfedge[star.link[i]];
    const std::uint32_t t = LiveMesh::triangleOf(std::atomic_ref(pointer).load(std::memory_order_relaxed));
    std::uint32_t beside;
    std::uint32_t* const where[] = {&beside, &pointer};
    std::atomic_ref(*where[(t == own) | (t == before)]).store(seams[i].movedTo, std::memory_order_relaxed);
    before = own;
  }

  for (int d = 0; d < joins.diagonalCount; ++d) {
    const std::uint32_t forth = halfedge(joins.diagonals[d].forth), back = halfedge(joins.diagonals[d].back);
    mesh.setTwin(forth, back);
    mesh.setTwin(back, forth);
  }
  for (int f = 0; f < floor.size; ++f) {
    const auto& local = floor.triangles[f];
    LiveMesh::Triangle& triangle = mesh.triangles[star.triangle(f)];
    triangle.corners = {star.link[local[0]], star.link[local[1]], star.link[local[2]]};
    triangle.birth = firstBirth + static_cast<std::uint32_t>(f);
    triangle.creator = removal;
  }
  for (int i = floor.size; i < star.triangleCount; ++i) {
    mesh.triangles[star.triangle(i)].corners[0] = LiveMesh::kNone;
    mesh.triangles[star.triangle(i)].creator = removal;
  }
}

}  // namespace arete
