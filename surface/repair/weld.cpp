// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices are joined by joining edges, never by position alone: a vertex where two parts touch has no edge
// to join. Border edges are grouped by the positions of their ends. A group of two is one seam. Larger groups
// wait until the seams have joined the triangles to parts: a part with two sides in a group closes there.
// What is left is paired by solids (sheet_pairs.h).
#include "surface/repair/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "engine/base/caught_failure.h"
#include "surface/repair/near_pairs.h"
#include "surface/repair/sheet_pairs.h"
#include "surface/topology/disjoint_sets.h"
#include "surface/topology/edges.h"

namespace arete {
namespace {

/// By vertex: of some, the lowest of them at its position; of any other, itself.
std::vector<std::uint32_t> firstAtPosition(std::span<const Vec3> positions,
                                           std::vector<std::uint32_t> order) {
  const auto key = [&](std::uint32_t v) {
    return std::tuple(positions[v].x + 0, positions[v].y + 0, positions[v].z + 0);  // -0 and 0 are one
  };
  std::vector<std::uint32_t> first(positions.size());
  std::iota(first.begin(), first.end(), 0u);
  std::ranges::sort(order);
  order.erase(std::unique(order.begin(), order.end()), order.end());
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    const auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  for (std::size_t i = 0, begin = 0; i < order.size(); ++i) {
    if (key(order[i]) != key(order[begin])) begin = i;
    first[order[i]] = order[begin];
  }
  return first;
}

/// The corners of the triangles that have a border edge, some more than once.
std::vector<std::uint32_t> verticesOfBorderTriangles(const MeshEdges& edges) {
  std::vector<std::uint32_t> vertices;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (const MeshEdges::Edge edge = edges[e]; edge.isBorder()) {
      const auto& triangle = edges.triangles()[triangleOf(edge.sides[0]).index()];
      vertices.insert(vertices.end(), triangle.begin(), triangle.end());
    }
  return vertices;
}

class Welder {
 public:
  Welder(const TriangleMesh& mesh, std::span<const Vec3> positions, std::span<const std::uint32_t> partOf)
      : edges_(mesh.triangles, mesh.positions.size()),
        positions_(positions),
        place_(firstAtPosition(positions, verticesOfBorderTriangles(edges_))),
        vertices_(mesh.positions.size()),
        parts_(mesh.triangles.size()) {
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const MeshEdges::Edge edge = edges_[e];
      for (const CornerId side : edge.sides.subspan(1))
        parts_.unite(triangleOf(edge.sides[0]).index(), triangleOf(side).index());
      if (!edge.isBorder()) continue;
      const CornerId side = edge.sides[0];
      std::uint32_t from = placeOf(edges_.origin(side)), to = placeOf(edges_.target(side));
      const bool isForward = from < to;
      if (!isForward) std::swap(from, to);
      if (from == to) continue;
      const std::uint32_t part = partOf.empty() ? 0 : partOf[triangleOf(side).index()];
      sides_.push_back({{part, from, to}, side, isForward});
    }
    std::ranges::sort(sides_, {}, [](const Side& s) { return std::tuple(s.key, s.side); });
  }

  std::uint64_t run() {
    std::vector<std::vector<Side>> groups;
    for (std::size_t i = 0; i < sides_.size();) {
      std::size_t end = i;
      while (end < sides_.size() && sides_[end].key == sides_[i].key) ++end;
      if (end - i == 2)
        join(sides_[i], sides_[i + 1]);
      else if (end - i > 2)
        groups.emplace_back(sides_.begin() + std::ptrdiff_t(i), sides_.begin() + std::ptrdiff_t(end));
      i = end;
    }
    for (std::uint64_t before = joined_ + 1; before != joined_;) {
      before = joined_;
      for (std::vector<Side>& group : groups) joinWithinParts(group);
    }
    for (std::vector<Side>& group : groups) joinBySolids(group);
    return joined_;
  }

  /// The lowest vertex that a vertex is joined with.
  std::uint32_t vertexOf(std::uint32_t v) { return vertices_.find(v); }

 private:
  struct Side {
    std::array<std::uint32_t, 3> key;  // part, places
    CornerId side;
    bool isForward;
  };

  std::uint32_t placeOf(VertexId v) const { return place_[v.index()]; }
  std::uint32_t apexPlace(const Side& s) const { return placeOf(edges_.origin(previousCorner(s.side))); }
  std::uint32_t partOf(const Side& s) { return parts_.find(triangleOf(s.side).index()); }

  void join(const Side& a, const Side& b) {
    const auto end = [&](const Side& s, bool isLow) {
      return (s.isForward == isLow ? edges_.origin(s.side) : edges_.target(s.side)).index();
    };
    vertices_.unite(end(a, true), end(b, true));
    vertices_.unite(end(a, false), end(b, false));
    parts_.unite(triangleOf(a.side).index(), triangleOf(b.side).index());
    ++joined_;
  }

  void joinWithinParts(std::vector<Side>& group) {
    std::ranges::stable_sort(group, {}, [&](const Side& s) { return partOf(s); });
    std::vector<Side> left;
    for (std::size_t i = 0; i < group.size();) {
      std::size_t end = i;
      while (end < group.size() && partOf(group[end]) == partOf(group[i])) ++end;
      const bool isPair = end - i == 2 && apexPlace(group[i]) != apexPlace(group[i + 1]);
      if (isPair)
        join(group[i], group[i + 1]);
      else
        left.insert(left.end(), group.begin() + std::ptrdiff_t(i), group.begin() + std::ptrdiff_t(end));
      i = end;
    }
    group = std::move(left);
    if (group.size() == 2) {
      join(group[0], group[1]);
      group.clear();
    }
  }

  void joinBySolids(const std::vector<Side>& group) {
    if (group.size() < 2) return;
    std::vector<repair_passes::SheetSide> sides;
    for (const Side& s : group)
      sides.push_back({s.side, positions_[edges_.origin(previousCorner(s.side)).index()], s.isForward});
    const auto find = [&](CornerId side) { return *std::ranges::find(group, side, &Side::side); };
    for (const auto& [a, b] :
         repair_passes::pairSheets(positions_[group[0].key[1]], positions_[group[0].key[2]], sides))
      join(find(a), find(b));
  }

  const MeshEdges edges_;
  std::span<const Vec3> positions_;
  std::vector<std::uint32_t> place_;  // by vertex
  DisjointSets vertices_, parts_;     // of vertices, of triangles
  std::vector<Side> sides_;           // of borders, by key
  std::uint64_t joined_ = 0;
};

/// The positions after the border vertices within a distance of each other have met: each takes the position
/// of the lowest vertex of its group. No group has two vertices of one triangle, and no vertex moves farther
/// than the distance.
std::vector<Vec3> gather(const TriangleMesh& mesh, double distance, std::span<const std::uint32_t> partOf) {
  const MeshEdges edges(mesh.triangles, mesh.positions.size());
  std::vector<std::vector<std::uint32_t>> trianglesAt(mesh.positions.size());
  std::vector<std::uint32_t> part(mesh.positions.size(), 0), border;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (const MeshEdges::Edge edge = edges[e]; edge.isBorder()) {
      border.push_back(edge.low.index());
      border.push_back(edge.high.index());
    }
  std::ranges::sort(border);
  border.erase(std::unique(border.begin(), border.end()), border.end());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) {
      trianglesAt[v].push_back(t);
      if (!partOf.empty()) part[v] = partOf[t];
    }

  std::vector<Vec3> positions = mesh.positions;
  std::vector<std::vector<std::uint32_t>> members(positions.size());  // by the lowest vertex of a group
  for (const std::uint32_t v : border) members[v] = {v};
  std::vector<std::uint32_t> lowest(positions.size());
  std::iota(lowest.begin(), lowest.end(), 0u);
  const auto shareTriangle = [&](std::uint32_t a, std::uint32_t b) {
    for (const std::uint32_t t : trianglesAt[a])
      if (std::ranges::find(mesh.triangles[t], b) != mesh.triangles[t].end()) return true;
    return false;
  };
  for (const auto& [a, b] : repair_passes::findNearPairs(mesh.positions, border, distance)) {
    std::uint32_t low = lowest[a], high = lowest[b];
    if (low == high || part[a] != part[b]) continue;
    if (low > high) std::swap(low, high);
    bool isFree = true;
    for (const std::uint32_t u : members[high]) {
      isFree = isFree && norm(mesh.positions[u] - mesh.positions[low]) <= distance;
      for (const std::uint32_t w : members[low]) isFree = isFree && !shareTriangle(u, w);
    }
    if (!isFree) continue;
    for (const std::uint32_t u : members[high]) {
      lowest[u] = low;
      positions[u] = mesh.positions[low];
      members[low].push_back(u);
    }
    members[high].clear();
  }
  return positions;
}

/// The mesh with each vertex replaced by the lowest that it is joined with; unused vertices stay.
WeldedMesh finish(const TriangleMesh& mesh, Welder& welder) {
  WeldedMesh welded;
  std::vector<std::uint32_t> number(mesh.positions.size());
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const std::uint32_t first = welder.vertexOf(v);
    if (first == v) {
      number[v] = static_cast<std::uint32_t>(welded.vertexOf.size());
      welded.vertexOf.push_back(v);
      welded.mesh.positions.push_back(mesh.positions[v]);
    } else {
      number[v] = number[first];
      ++welded.joinedVertices;
      welded.farthestMove = std::max(welded.farthestMove, norm(mesh.positions[v] - mesh.positions[first]));
    }
  }
  welded.mesh.triangles = mesh.triangles;
  for (auto& t : welded.mesh.triangles)
    for (std::uint32_t& v : t) v = number[v];
  return welded;
}

WeldedMesh weldEqual(const TriangleMesh& mesh, std::span<const Vec3> positions,
                     std::span<const std::uint32_t> partOf) {
  Welder welder(mesh, positions, partOf);
  const std::uint64_t joined = welder.run();
  WeldedMesh welded = finish(mesh, welder);
  welded.joinedEdges = joined;
  return welded;
}

}  // namespace

Result<WeldedMesh> weld(const TriangleMesh& mesh, const WeldOptions& options, const RunContext& context) try {
  ARETE_CHECK(mesh.validate());
  if (!(options.distance >= 0 && std::isfinite(options.distance)))
    return failure(ErrorCode::usage, "the distance must be 0 or more", "distance");
  if (!options.partOf.empty() && options.partOf.size() != mesh.triangles.size())
    return failure(ErrorCode::invalidData, "there must be one part for each triangle", "partOf");
  if (mesh.triangles.size() >= std::numeric_limits<std::uint32_t>::max() / 3)
    return failure(ErrorCode::unsupported,
                   "the mesh has more triangles than 32-bit numbers of corners allow");
  context.report("weld", 0);
  WeldedMesh welded = weldEqual(mesh, mesh.positions, options.partOf);
  if (options.distance > 0) {
    if (context.cancelled()) return failure(ErrorCode::interrupted, "welding was interrupted");
    const std::vector<Vec3> gathered = gather(welded.mesh, options.distance, options.partOf);
    WeldedMesh second = weldEqual(welded.mesh, gathered, options.partOf);
    for (std::uint32_t& v : second.vertexOf) v = welded.vertexOf[v];
    second.joinedVertices += welded.joinedVertices;
    second.joinedEdges += welded.joinedEdges;
    welded = std::move(second);
  }
  context.report("weld", 1);
  return welded;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
