// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/id_array.h"
#include "engine/base/ids.h"
#include "engine/memory/paged_array.h"
#include "engine/memory/uninitialized_vector.h"
#include "engine/mt/recorder.h"
#include "engine/simplify/floor_joins.h"
#include "engine/simplify/hole_triangles.h"
#include "engine/simplify/slot_map.h"

namespace arete {

/// A directed edge of a LiveMesh. Invalid (the default): there is none, as beyond a border.
using HalfedgeId = Id<struct HalfedgeTag>;

/// The triangulation that a build shrinks: triangle slots with half-edges.
///
/// Half-edge 4 t + i is the directed edge from corner i of the triangle in slot t to corner i + 1; its twin
/// is the same edge of the neighbour, invalid on a border. Triangles turn counter-clockwise.
/// vertexHalfedge[v] is an outgoing half-edge of v, and the border one if v lies on a border, so that a walk
/// around an open star starts at its first triangle.
///
///        to
///       /|\       h: from -> to, the triangle t on its left
///      / | \      g = twinOf(h): to -> from, the triangle u on its left
///     / t|u \     nextInTriangle(h) leaves `to`
///     \  |  /     previousInTriangle(h) arrives at `from`
///      \ | /
///       \|/
///       from
///
/// A removal reuses the first slots of its star and leaves two of them dead, one if the star is open.
struct LiveMesh {
  using Corners = std::array<VertexId, 3>;

  /// One triangle in half a cache line: the time of a walk around a star is that of the lines it touches.
  struct alignas(32) Triangle {
    Corners corners;                 ///< corners[0] is invalid: the slot is dead
    std::array<HalfedgeId, 3> twin;  ///< twin[i]: of the half-edge from corner i
    RecorderId recorderId;
    RemovalId creator;  ///< the removal that added the triangle, invalid in the finest triangulation; of a
                        ///< dead slot: the removal that emptied it
    bool isDead() const { return !corners[0].isValid(); }
  };
  IdArray<SlotId, PagedArray<Triangle>> triangles;
  IdArray<VertexId, PagedArray<HalfedgeId>> vertexHalfedge;  ///< invalid if the vertex is in no triangle

  /// Makes the mesh of counter-clockwise triangles: finds the twins, numbers the triangles by their order.
  /// O(triangles). Precondition: an edge has at most one triangle on either side; there are no more than
  /// kMostTriangles.
  /// @param pinched receives the vertices whose triangles form more than one fan.
  static LiveMesh fromTriangles(std::vector<std::array<std::uint32_t, 3>> corners, std::uint32_t vertexCount,
                                std::vector<VertexId>& pinched);

  /// Drops dead slots; the others move up and keep their order. Without it, levels that remove a few vertices
  /// of a mesh with few triangles left would touch all of its former memory. O(slots + vertices), parallel.
  /// @param vertices all vertices that are in a triangle; invalid ones are skipped.
  /// @return where each slot moved.
  SlotMap compact(std::span<const VertexId> vertices);

  /// The vertices that are in a triangle, in the order of their half-edges. O(slots), parallel.
  UninitializedVector<VertexId> verticesInOrder() const;

  /// The largest number of triangles whose half-edges have 32-bit ids.
  static constexpr std::uint32_t kMostTriangles = (HalfedgeId::kInvalid >> 2) - 1;

  static HalfedgeId halfedge(SlotId slot, std::uint32_t side) { return HalfedgeId(4 * slot.index() + side); }
  static SlotId slotOf(HalfedgeId h) { return SlotId(h.index() >> 2); }
  static std::uint32_t sideOf(HalfedgeId h) { return h.index() & 3; }
  // A table of two bits for each side instead of a comparison: the side is not predictable.
  static HalfedgeId nextInTriangle(HalfedgeId h) {
    return HalfedgeId((h.index() & ~3u) | (0b00'10'01u >> 2 * sideOf(h) & 3));
  }
  static HalfedgeId previousInTriangle(HalfedgeId h) {
    return HalfedgeId((h.index() & ~3u) | (0b01'00'10u >> 2 * sideOf(h) & 3));
  }
  // Preconditions: h is valid.
  VertexId origin(HalfedgeId h) const { return triangles[slotOf(h)].corners[sideOf(h)]; }
  HalfedgeId twinOf(HalfedgeId h) const { return triangles[slotOf(h)].twin[sideOf(h)]; }
  void setTwin(HalfedgeId h, HalfedgeId to) { triangles[slotOf(h)].twin[sideOf(h)] = to; }

  std::size_t vertexCount() const { return vertexHalfedge.size(); }
  bool isInTriangle(VertexId vertex) const { return vertexHalfedge[vertex].isValid(); }
};

/// The star of a vertex of a LiveMesh: its triangles, and its link counter-clockwise. Triangle i lies between
/// link[i] and link[i + 1]; the link of a closed star is a cycle, that of an open one a path along which it
/// has one vertex more than triangles.
struct Star {
  std::array<VertexId, kMaxHoleCorners> link;
  std::array<HalfedgeId, kMaxHoleCorners> outgoing;  ///< half-edge vertex -> link[i] of triangle i
  int linkSize = 0;
  int triangleCount = 0;
  bool isOpen = false;  ///< the vertex lies on a border

  /// The slot of triangle i.
  SlotId slot(int i) const { return LiveMesh::slotOf(outgoing[i]); }
  /// Half-edge link[i] -> link[i + 1].
  HalfedgeId rim(int i) const { return LiveMesh::nextInTriangle(outgoing[i]); }
  std::span<const VertexId> linkView() const { return {link.data(), std::size_t(linkSize)}; }

  /// How many slots of a star are dead after the removal of its vertex.
  static std::size_t slotsLeftDead(bool isOpen) { return isOpen ? 1 : 2; }

  /// Gathers the star of v.
  /// @return false if the link has more than maxLink vertices, or v is in no triangle; the star is then
  /// undefined.
  bool gather(const LiveMesh& mesh, VertexId v, int maxLink);
};

/// Calls visit(u) for each link vertex u of v, counter-clockwise, until it returns false. Precondition: v is
/// in a triangle.
template <class Visit>
void forLink(const LiveMesh& mesh, VertexId v, const Visit& visit) {
  const HalfedgeId first = mesh.vertexHalfedge[v];
  for (HalfedgeId h = first;;) {
    if (!visit(mesh.origin(LiveMesh::nextInTriangle(h)))) return;
    const HalfedgeId last = LiveMesh::previousInTriangle(h);
    h = mesh.twinOf(last);
    if (h == first) return;
    if (!h.isValid()) {
      visit(mesh.origin(last));
      return;
    }
  }
}

/// An edge of a star's rim, between the rewriting of the star and the joining of the new triangle to the
/// neighbour beyond the edge. The last seam of an open star is the new border edge that closes its hole.
struct Seam {
  HalfedgeId movedFrom;  ///< half-edge of the rim before the removal, invalid for a new border edge
  HalfedgeId movedTo;    ///< the same edge after the removal
  HalfedgeId beyond;     ///< its twin before the removal, invalid on a border
};

/// Replaces the triangles of a star by those of a floor: rewrites its slots, the twins between them and the
/// half-edges of the link's vertices. Writes nothing outside the star; the caller joins the new triangles to
/// their neighbours: by sewAlone() at once, or by sew() when all stars of a batch are rewritten.
/// @param joins of the floor.
/// @param firstId of the floor's first triangle; those of the others follow.
/// @param seams one for each vertex of the link, filled in.
void refill(LiveMesh& mesh, const Star& star, const HoleTriangulation& floor, const FloorJoins& joins,
            RecorderId firstId, RemovalId removal, std::span<Seam> seams);

/// Joins an edge of a floor's rim to its neighbour, which has not moved since the star was rewritten.
inline void sewAlone(LiveMesh& mesh, const Seam& seam) {
  mesh.setTwin(seam.movedTo, seam.beyond);
  if (seam.beyond.isValid()) mesh.setTwin(seam.beyond, seam.movedTo);
}

/// Joins an edge of a floor's rim to its neighbour, which may have moved in the same batch.
/// @param firstRemoval of the batch: a slot whose creator is this removal or a later one has moved.
/// @param seamsOf seamsOf(removal): the seams of a removal of the batch.
template <class SeamsOf>
void sew(LiveMesh& mesh, const Seam& seam, RemovalId firstRemoval, const SeamsOf& seamsOf) {
  if (!seam.beyond.isValid()) return sewAlone(mesh, seam);
  const RemovalId creator = mesh.triangles[LiveMesh::slotOf(seam.beyond)].creator;
  if (!creator.isValid() || creator < firstRemoval) return sewAlone(mesh, seam);
  for (const Seam& other : seamsOf(creator))
    if (other.movedFrom == seam.beyond) {
      mesh.setTwin(seam.movedTo, other.movedTo);
      return;
    }
  assert(false && "a half-edge of a rewritten slot has a seam");
}

}  // namespace arete
