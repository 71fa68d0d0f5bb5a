// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace arete {

/// Keeps the lines between the parts of a mesh (surface/model/parts.h) while CGAL collapses its edges: a
/// vertex on a line goes along it alone, to the place of its neighbour; where lines end or branch it stays;
/// and a part never vanishes. A line is where the parts of two faces differ, so it is known after every
/// collapse.
template <class Mesh>
class PartLines {
 public:
  using Vertex = typename Mesh::Vertex_index;
  using Halfedge = typename Mesh::Halfedge_index;
  using Point = typename Mesh::Point;

  /// @param partOf by face; empty: there is no line. Both outlive this.
  PartLines(const Mesh& mesh, const std::vector<std::uint32_t>& partOf) : mesh_(&mesh), partOf_(&partOf) {}

  /// Whether an edge has an end on a line, so that chooseEnd() says where it may go.
  bool areAt(Halfedge h) const {
    return !partOf_->empty() && (spokesAt(mesh_->source(h)) > 0 || spokesAt(mesh_->target(h)) > 0);
  }
  /// The end whose place the edge may collapse to; none: it stays. Precondition: areAt().
  std::optional<Vertex> chooseEnd(Halfedge h) const {
    if (!leavesParts(h) || !leavesParts(mesh_->opposite(h))) return std::nullopt;
    const Vertex v0 = mesh_->source(h), v1 = mesh_->target(h);
    const bool mayGo0 = mayGo(v0, v1, h), mayGo1 = mayGo(v1, v0, h);
    if (mayGo0 && mayGo1) return squaredLoss(v0, v1) <= squaredLoss(v1, v0) ? v1 : v0;
    if (mayGo0) return v1;
    return mayGo1 ? std::optional(v0) : std::nullopt;
  }
  /// The squared area, four times, between the line and what is left of it when v goes to a neighbour; 0 if v
  /// is on no line.
  double squaredLoss(Vertex v, Vertex to) const {
    double most = 0;
    forSpokes(v, [&](Vertex end) {
      const auto loss =
          CGAL::cross_product(mesh_->point(to) - mesh_->point(end), mesh_->point(v) - mesh_->point(end));
      most = std::max(most, loss.squared_length());
    });
    return most;
  }

 private:
  bool isLine(Halfedge h) const {
    const auto a = mesh_->face(h), b = mesh_->face(mesh_->opposite(h));
    return a != Mesh::null_face() && b != Mesh::null_face() && (*partOf_)[a] != (*partOf_)[b];
  }
  template <class Visit>
  void forSpokes(Vertex v, const Visit& visit) const {
    for (const Halfedge h : mesh_->halfedges_around_target(mesh_->halfedge(v)))
      if (isLine(h)) visit(mesh_->source(h));
  }
  int spokesAt(Vertex v) const {
    int count = 0;
    forSpokes(v, [&](Vertex) { ++count; });
    return count;
  }
  bool mayGo(Vertex v, Vertex to, Halfedge h) const {
    if (mesh_->is_border(v, true) && !mesh_->is_border(to, true)) return false;
    const int spokes = spokesAt(v);
    return spokes == 0 ? spokesAt(to) > 0 : spokes == 2 && isLine(h) && !mesh_->is_border(v, true);
  }
  /// Whether the part of the face at h, which a collapse removes, goes on beyond one of its other sides.
  bool leavesParts(Halfedge h) const {
    const auto face = mesh_->face(h);
    if (face == Mesh::null_face()) return true;
    for (const Halfedge side : {mesh_->next(h), mesh_->prev(h)}) {
      const auto beyond = mesh_->face(mesh_->opposite(side));
      if (beyond != Mesh::null_face() && (*partOf_)[beyond] == (*partOf_)[face]) return true;
    }
    return false;
  }

  const Mesh* mesh_;
  const std::vector<std::uint32_t>* partOf_;
};

}  // namespace arete
