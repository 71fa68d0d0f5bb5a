// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/memory/paged_array.h"
#include "engine/memory/uninitialized_vector.h"
#include "engine/mt/recorder.h"
#include "engine/simplify/floor_joins.h"
#include "engine/simplify/hole_triangulation.h"
#include "engine/simplify/slot_map.h"

namespace arete {

/// The triangulation that a build shrinks: compact triangle arrays with half-edges.
///
/// Half-edge 4 t + i is the directed edge from corner i of triangle t to corner i + 1; its twin is the same
/// edge of the neighbour, or kNone on a border. Triangles turn counter-clockwise. vertexHalfedge[v] is an
/// outgoing half-edge of v, and the border one when v lies on a border, so that a walk around an open star
/// starts at its first triangle.
///
/// A removal reuses the first slots of its star and leaves two dead (corner kNone).
struct LiveMesh {
  static constexpr std::uint32_t kNone = MtRecorder::kNone;
  using Corners = std::array<std::uint32_t, 3>;

  /// One triangle in half a cache line: a walk around a star is bound by the lines it touches.
  struct alignas(32) Triangle {
    Corners corners;
    Corners twin;
    std::uint32_t birth;    ///< birth id in the recorder
    std::uint32_t creator;  ///< the removal that bore it, or kNone; of a dead slot: the removal that left it
    bool isDead() const { return corners[0] == kNone; }
  };
  PagedArray<Triangle> triangles;
  UninitializedVector<std::uint32_t> vertexHalfedge;  ///< per vertex, kNone for a vertex in no triangle

  /// Half-edges and births for counter-clockwise triangles. `pinched` receives the vertices whose triangles
  /// form more than one fan. O(triangles). Precondition: an edge has at most one triangle on either side;
  /// there are no more than kMostTriangles.
  static LiveMesh fromTriangles(std::vector<Corners> corners, std::uint32_t vertexCount,
                                std::vector<std::uint32_t>& pinched);

  /// Drops dead slots; the others keep their order and move up. Returns where they went. Levels that remove a
  /// few vertices from a mesh long thinned out would otherwise wander through all of its memory. `vertices`:
  /// all that are in a triangle, and kNone any number of times. O(slots + vertices), parallel.
  SlotMap compact(std::span<const std::uint32_t> vertices);

  /// The vertices that are in a triangle, by their half-edges. O(slots), parallel.
  UninitializedVector<std::uint32_t> verticesInOrder() const;

  static constexpr std::uint32_t kMostTriangles = (kNone >> 2) - 1;  ///< that half-edges can name

  static std::uint32_t halfedge(std::uint32_t triangle, std::uint32_t side) { return 4 * triangle + side; }
  static std::uint32_t triangleOf(std::uint32_t h) { return h >> 2; }
  static std::uint32_t sideOf(std::uint32_t h) { return h & 3; }
  // Two bits for each side say which one comes next, and before: which side it is nobody foresees.
  static std::uint32_t nextInTriangle(std::uint32_t h) {
    return (h & ~3u) | (0b00'10'01u >> 2 * (h & 3) & 3);
  }
  static std::uint32_t previousInTriangle(std::uint32_t h) {
    return (h & ~3u) | (0b01'00'10u >> 2 * (h & 3) & 3);
  }
  std::uint32_t origin(std::uint32_t h) const { return triangles[triangleOf(h)].corners[sideOf(h)]; }
  std::uint32_t twinOf(std::uint32_t h) const { return triangles[triangleOf(h)].twin[sideOf(h)]; }
  void setTwin(std::uint32_t h, std::uint32_t to) { triangles[triangleOf(h)].twin[sideOf(h)] = to; }
};

/// The star of a vertex of a LiveMesh: link counter-clockwise, one triangle between consecutive link
/// vertices.
struct Star {
  std::array<std::uint32_t, kMaxHoleCorners> link;
  std::array<std::uint32_t, kMaxHoleCorners> outgoing;  ///< half-edge vertex -> link[i] of triangle i
  int linkSize = 0;
  int triangleCount = 0;
  bool isOpen = false;

  std::uint32_t triangle(int i) const { return LiveMesh::triangleOf(outgoing[i]); }
  /// Half-edge link[i] -> link[i + 1].
  std::uint32_t rim(int i) const { return LiveMesh::nextInTriangle(outgoing[i]); }
  std::span<const std::uint32_t> linkView() const { return {link.data(), std::size_t(linkSize)}; }

  /// How many of a star's triangles' slots hold none when its vertex is gone.
  static std::size_t slotsLeftDead(bool isOpen) { return isOpen ? 1 : 2; }

  /// Gathers the star of v; false when its link has more than maxLink vertices (or v has no triangle).
  bool gather(const LiveMesh& mesh, std::uint32_t v, int maxLink);
};

/// Calls visit(u) for each link vertex of v, counter-clockwise, until it returns false. Precondition: v is in
/// a triangle.
template <class Visit>
void forLink(const LiveMesh& mesh, std::uint32_t v, const Visit& visit) {
  const std::uint32_t first = mesh.vertexHalfedge[v];
  for (std::uint32_t h = first;;) {
    if (!visit(mesh.origin(LiveMesh::nextInTriangle(h)))) return;
    const std::uint32_t last = LiveMesh::previousInTriangle(h);
    h = mesh.twinOf(last);
    if (h == first) return;
    if (h == LiveMesh::kNone) {
      visit(mesh.origin(last));
      return;
    }
  }
}

/// What a removal leaves to do of an edge of its star's rim: to join it to what lies beyond. Of an open star
/// the last one is of the new border edge that closes its hole.
struct Seam {
  std::uint32_t movedFrom;  ///< half-edge of the rim before the removal, kNone for a new border edge
  std::uint32_t movedTo;    ///< the same after it
  std::uint32_t beyond;     ///< its twin before it, kNone on a border
};

/// Fills the star's hole with the floor: rewrites its triangle slots, inner twins and the half-edges of the
/// link. Touches nothing outside the star and fills in `seams`, one for each vertex of the link, which are to
/// be sewn: at once by sewAlone(), or by sew() when all stars of a batch are rewritten. `joins`: of the
/// floor.
void refill(LiveMesh& mesh, const Star& star, const HoleTriangulation& floor, const FloorJoins& joins,
            std::uint32_t firstBirth, std::uint32_t removal, std::span<Seam> seams);

/// Joins an edge of a floor's rim to what lies beyond it, which is where it was when the star was rewritten.
inline void sewAlone(LiveMesh& mesh, const Seam& seam) {
  mesh.setTwin(seam.movedTo, seam.beyond);
  if (seam.beyond != LiveMesh::kNone) mesh.setTwin(seam.beyond, seam.movedTo);
}

/// Joins an edge of a floor's rim to what lies beyond it, whether that moved in the same batch or not.
/// `firstRemoval`: of this batch; slots that a removal from it on has rewritten have moved.
/// seamsOf(removal): the seams of a removal of the batch.
template <class SeamsOf>
void sew(LiveMesh& mesh, const Seam& seam, std::uint32_t firstRemoval, const SeamsOf& seamsOf) {
  if (seam.beyond == LiveMesh::kNone) return sewAlone(mesh, seam);
  const std::uint32_t creator = mesh.triangles[LiveMesh::triangleOf(seam.beyond)].creator;
  if (creator == LiveMesh::kNone || creator < firstRemoval) return sewAlone(mesh, seam);
  for (const Seam& other : seamsOf(creator))
    if (other.movedFrom == seam.beyond) {
      mesh.setTwin(seam.movedTo, other.movedTo);
      return;
    }
  assert(false && "a half-edge of a rewritten slot has a seam");
}

}  // namespace arete
