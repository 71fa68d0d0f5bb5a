// SPDX-License-Identifier: GPL-3.0-or-later
//
// A border loop is filled by the triangulation of least area and dihedral angles [BarequetSharir1995], as
// CGAL finds it. It is left open where the filling needs an edge that exists, or a triangle that does.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/utility.h>

#include <algorithm>
#include <iterator>

#include "surface/repair/draft.h"
#include "surface/repair/neighbourhood.h"
#include "surface/topology/border_loops.h"

namespace arete::repair_passes {
namespace {

/// The vertices of a loop in the order in which its triangles have them; empty where it passes one twice, or
/// its triangles turn against each other.
std::vector<std::uint32_t> cornersOf(const MeshEdges& edges, const BorderLoop& loop) {
  std::vector<std::uint32_t> corners;
  bool isForward = true, isBackward = true;
  for (std::size_t i = 0; i < loop.sides.size(); ++i) {
    const CornerId side = loop.sides[i], next = loop.sides[(i + 1) % loop.sides.size()];
    isForward = isForward && edges.target(side) == edges.origin(next);
    isBackward = isBackward && edges.origin(side) == edges.target(next);
    corners.push_back(edges.origin(side).index());
  }
  if (!isForward && !isBackward) return {};
  if (!isForward) std::ranges::reverse(corners);
  std::vector<std::uint32_t> sorted = corners;
  std::ranges::sort(sorted);
  return std::ranges::adjacent_find(sorted) == sorted.end() ? corners : std::vector<std::uint32_t>();
}

}  // namespace

void fillHoles(Draft& draft, std::uint32_t mostEdges) {
  if (mostEdges == 0) return;
  std::vector<std::vector<std::uint32_t>> holes;
  {
    const MeshEdges edges(draft.mesh.triangles, draft.mesh.positions.size());
    for (const BorderLoop& loop : findBorderLoops(edges, MeshFans(edges)))
      if (loop.isClosed && loop.sides.size() >= 3 && loop.sides.size() <= mostEdges)
        if (auto corners = cornersOf(edges, loop); !corners.empty()) holes.push_back(std::move(corners));
  }
  Neighbourhood neighbours(draft.mesh);
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  for (const std::vector<std::uint32_t>& hole : holes) {
    std::vector<Point> outline;
    for (const std::uint32_t v : hole) {
      const Vec3& p = draft.mesh.positions[v];
      outline.emplace_back(p.x, p.y, p.z);
    }
    using Patch = CGAL::Triple<int, int, int>;
    std::vector<Patch> patch;
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(outline, std::back_inserter(patch));
    const int size = static_cast<int>(hole.size());
    bool isFree = patch.size() + 2 == hole.size();
    for (const Patch& t : patch)
      for (const auto& [i, j] :
           {std::pair(t.first, t.second), std::pair(t.second, t.third), std::pair(t.third, t.first)}) {
        const bool isOnOutline = (i + 1) % size == j || (j + 1) % size == i;
        const std::size_t there = neighbours.atEdge(hole[std::size_t(i)], hole[std::size_t(j)]).size();
        isFree = isFree && there == (isOnOutline ? 1u : 0u);
      }
    // A triangle whose outline is the hole would be its own lid.
    if (hole.size() == 3 && isFree) {
      const auto beside = neighbours.atEdge(hole[0], hole[1]);
      isFree = !neighbours.has(beside[0], hole[2]);
    }
    if (!isFree) continue;
    ++draft.counts.filledHoles;
    for (const Patch& t : patch) {
      // The outline runs as its triangles do; those of the filling run the other way.
      Triangle corners{hole[std::size_t(t.first)], hole[std::size_t(t.third)], hole[std::size_t(t.second)]};
      const bool runsAsOutline = (t.first < t.second) + (t.second < t.third) + (t.third < t.first) == 2;
      if (!runsAsOutline) std::swap(corners[1], corners[2]);
      draft.mesh.triangles.push_back(corners);
      draft.triangleOf.push_back(RepairedMesh::kNone);
      neighbours.add(static_cast<std::uint32_t>(draft.mesh.triangles.size() - 1));
      ++draft.counts.fillingTriangles;
    }
  }
}

}  // namespace arete::repair_passes
