// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangle at a border edge becomes a fan around its apex, with the vertices inside the edge in their
// order. A vertex is left out where the fan would get an edge that has two triangles already, an edge to the
// apex that exists, or a triangle that has no area or turns over, as one that is no thicker than the
// rounding.
//
// The corners of the triangle may be copies of those beyond the edge, which nothing joined while it was
// longer than the edges there: now they become one.
#include <algorithm>
#include <map>

#include "surface/diagnosis/parts.h"
#include "surface/repair/draft.h"
#include "surface/repair/joining.h"
#include "surface/repair/neighbourhood.h"
#include "surface/repair/places.h"
#include "surface/topology/edges.h"

namespace arete::repair_passes {
namespace {

/// The vertices inside one side of a triangle, in the order in which the side runs.
std::vector<std::uint32_t> inOrder(const TriangleMesh& mesh, std::uint32_t from,
                                   std::vector<std::uint32_t> inside) {
  const auto distance = [&](std::uint32_t v) { return norm(mesh.positions[v] - mesh.positions[from]); };
  std::ranges::sort(inside, [&](std::uint32_t a, std::uint32_t b) {
    const double da = distance(a), db = distance(b);
    return da != db ? da < db : a < b;
  });
  return inside;
}

/// Joins edges that splits made with the one border edge that lies in the same place, runs the other way and
/// is of the same part.
void joinAlong(Draft& draft, const std::vector<std::array<std::uint32_t, 2>>& made,
               std::span<const std::uint32_t> partOf) {
  using Side = std::array<std::uint32_t, 3>;  // from, to, triangle
  const TriangleMesh& mesh = draft.mesh;
  const std::vector<std::uint32_t> placeOf = placesOf(mesh.positions);
  const auto key = [&](std::uint32_t a, std::uint32_t b) { return std::minmax({placeOf[a], placeOf[b]}); };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Side>> at;
  for (const auto& [a, b] : made) at[key(a, b)];
  {
    const MeshEdges edges(mesh.triangles, mesh.positions.size());
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const MeshEdges::Edge edge = edges[e];
      if (!edge.isBorder()) continue;
      const auto found = at.find(key(edge.low.index(), edge.high.index()));
      if (found == at.end()) continue;
      const CornerId side = edge.sides[0];
      found->second.push_back(
          {edges.origin(side).index(), edges.target(side).index(), triangleOf(side).index()});
    }
  }
  Neighbourhood neighbours(mesh);
  Joining joining(draft, neighbours);
  const auto part = [&](const Side& side) {
    return partOf.empty() || draft.triangleOf[side[2]] == RepairedMesh::kNone
               ? 0
               : partOf[draft.triangleOf[side[2]]];
  };
  for (const auto& [places, sides] : at) {
    if (sides.size() != 2 || placeOf[sides[0][0]] != placeOf[sides[1][1]] || part(sides[0]) != part(sides[1]))
      continue;
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}})
      if (joining.canJoin(sides[0][end], sides[1][1 - end])) joining.join(sides[0][end], sides[1][1 - end]);
  }
}

}  // namespace

bool splitAtTJunctions(Draft& draft, double distance, std::span<const std::uint32_t> partOf) {
  TriangleMesh& mesh = draft.mesh;
  std::map<CornerId, std::vector<std::uint32_t>> insideOf;  // by border side
  {
    const MeshEdges edges(mesh.triangles, mesh.positions.size());
    std::map<std::array<std::uint32_t, 2>, CornerId> sideOf;
    std::vector<std::array<std::uint32_t, 2>> borders;
    std::vector<std::uint32_t> vertices;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const MeshEdges::Edge edge = edges[e];
      if (!edge.isBorder()) continue;
      borders.push_back({edge.low.index(), edge.high.index()});
      sideOf[borders.back()] = edge.sides[0];
      vertices.insert(vertices.end(), borders.back().begin(), borders.back().end());
    }
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const diagnosis::TJunction& t :
         diagnosis::findTJunctions(mesh.positions, borders, vertices, distance))
      insideOf[sideOf.at({t.low, t.high})].push_back(t.vertex);
  }
  if (insideOf.empty()) return false;

  Neighbourhood neighbours(mesh);
  std::vector<std::array<std::uint32_t, 2>> made;
  TriangleId lastSplit;
  for (const auto& [corner, inside] : insideOf) {
    // One side of a triangle at a time: the split gives its other sides to other triangles. The next call
    // finds them.
    if (triangleOf(corner) == lastSplit) continue;
    const std::uint32_t t = triangleOf(corner).index(), side = corner.index() % 3;
    const std::uint32_t from = mesh.triangles[t][side], to = mesh.triangles[t][(side + 1) % 3],
                        apex = mesh.triangles[t][(side + 2) % 3];
    if (neighbours.atEdge(from, to).size() != 1) continue;
    std::uint32_t last = from;
    for (const std::uint32_t v : inOrder(mesh, from, inside)) {
      const auto& p = mesh.positions;
      const Vec3 normal = cross(p[to] - p[last], p[apex] - p[last]);
      const bool isFree = v != apex && neighbours.atEdge(last, v).size() < 2 &&
                          neighbours.atEdge(v, to).size() < 2 && neighbours.atEdge(v, apex).empty() &&
                          norm(p[v] - p[last]) > distance &&
                          !diagnosis::areCollinear(p[last], p[v], p[apex]) &&
                          !diagnosis::areCollinear(p[v], p[to], p[apex]) &&
                          dot(cross(p[v] - p[last], p[apex] - p[last]), normal) > 0 &&
                          dot(cross(p[to] - p[v], p[apex] - p[v]), normal) > 0;
      if (!isFree) continue;
      // last -> v becomes a triangle of its own, what is left runs from v on.
      draft.addTriangle({last, v, apex}, t);
      neighbours.add(static_cast<std::uint32_t>(mesh.triangles.size() - 1));
      neighbours.remove(t);
      mesh.triangles[t] = {v, to, apex};
      neighbours.add(t);
      last = v;
      ++draft.counts.tJunctions;
      made.push_back({mesh.triangles.back()[0], v});
      made.push_back({v, to});
      lastSplit = triangleOf(corner);
    }
  }
  if (made.empty()) return false;
  joinAlong(draft, made, partOf);
  return true;
}

}  // namespace arete::repair_passes
