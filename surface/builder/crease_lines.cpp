// SPDX-License-Identifier: GPL-3.0-or-later
//
// Corners of a vertex are joined across edges that are no creases (union by the root with the lower number);
// a wedge belongs to a former wedge and a root. Where one crease ends inside the surface all corners have one
// root, so that the edge is a line by its other end only. Lines with two such ends are followed, and what
// keeps them is named.
#include "surface/builder/crease_lines.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>

#include "engine/base/crease.h"
#include "surface/normals/smooth_corners.h"
#include "surface/topology/edges.h"

namespace arete {
namespace {

class CornerSectors {
 public:
  explicit CornerSectors(std::size_t corners) : root_(corners) { std::iota(root_.begin(), root_.end(), 0u); }

  void join(CornerId a, CornerId b) {
    const std::uint32_t first = of(a.index()), second = of(b.index());
    root_[std::max(first, second)] = std::min(first, second);
  }
  std::uint32_t of(std::uint32_t corner) {
    while (root_[corner] != corner) corner = root_[corner] = root_[root_[corner]];
    return corner;
  }

 private:
  std::vector<std::uint32_t> root_;
};

/// The creases at each vertex.
class CreaseGraph {
 public:
  explicit CreaseGraph(std::span<const Vec3> places)
      : places_(places), neighbours_(places.size()), isOnBorder_(places.size(), 0) {}

  void add(VertexId a, VertexId b) {
    neighbours_[a.index()].push_back(b.index());
    neighbours_[b.index()].push_back(a.index());
  }
  void addBorder(VertexId v) { isOnBorder_[v.index()] = 1; }

  /// CreaseLines::fixed.
  std::vector<std::uint32_t> fixed() const {
    std::vector<std::uint32_t> all;
    for (std::uint32_t v = 0; v < neighbours_.size(); ++v) {
      if (!isEnd(v)) continue;
      const std::vector<std::uint32_t> line = follow(v);
      if (line.back() < v || !isEnd(line.back())) continue;
      if (line.size() == 2)
        all.insert(all.end(), line.begin(), line.end());
      else
        all.push_back(middleOf(line));
    }
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

 private:
  bool isEnd(std::uint32_t v) const { return neighbours_[v].size() == 1 && isOnBorder_[v] == 0; }

  /// From an end to where the line ends, branches or meets a border.
  std::vector<std::uint32_t> follow(std::uint32_t end) const {
    std::vector<std::uint32_t> line{end, neighbours_[end][0]};
    while (neighbours_[line.back()].size() == 2 && isOnBorder_[line.back()] == 0) {
      const auto& next = neighbours_[line.back()];
      line.push_back(next[0] == line[line.size() - 2] ? next[1] : next[0]);
    }
    return line;
  }

  /// The vertex inside that is farthest from the nearer end.
  std::uint32_t middleOf(std::span<const std::uint32_t> line) const {
    const Vec3 &a = places_[line.front()], &b = places_[line.back()];
    return *std::ranges::max_element(line.subspan(1, line.size() - 2), {}, [&](std::uint32_t v) {
      return std::min(norm(places_[v] - a), norm(places_[v] - b));
    });
  }

  std::span<const Vec3> places_;
  std::vector<std::vector<std::uint32_t>> neighbours_;
  std::vector<std::uint8_t> isOnBorder_;
};

/// Gives the corners of each former wedge and sector a wedge of their own.
void divideWedges(SurfaceMesh& mesh, CornerSectors& sectors) {
  using Pair = std::pair<std::uint32_t, std::uint32_t>;  // a former wedge and a sector
  std::vector<Pair> pairs;
  const auto pairAt = [&](std::uint32_t corner) {
    return Pair(mesh.hasWedges() ? mesh.wedges[corner / 3][corner % 3] : 0, sectors.of(corner));
  };
  const auto corners = static_cast<std::uint32_t>(3 * mesh.triangles.size());
  pairs.reserve(corners);
  for (std::uint32_t c = 0; c < corners; ++c) pairs.push_back(pairAt(c));
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  for (Attribute& attribute : mesh.wedgeAttributes) {
    Attribute divided = emptyLike(attribute);
    for (const Pair& p : pairs) divided.append(attribute.element(p.first));
    attribute = std::move(divided);
  }
  std::vector<std::array<std::uint32_t, 3>> wedges(mesh.triangles.size());
  for (std::uint32_t c = 0; c < corners; ++c)
    wedges[c / 3][c % 3] =
        static_cast<std::uint32_t>(std::ranges::lower_bound(pairs, pairAt(c)) - pairs.begin());
  mesh.wedges = std::move(wedges);
  mesh.wedgeCount = static_cast<std::uint32_t>(pairs.size());
}

}  // namespace

CreaseLines makeCreasesLines(SurfaceMesh& mesh, double creaseDegrees) {
  const std::vector<Vec3> normals = faceNormals(mesh);
  const MeshEdges edges(mesh.triangles, mesh.positions.size());
  CornerSectors sectors(3 * mesh.triangles.size());
  CreaseGraph graph(mesh.positions);
  CreaseLines lines;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const MeshEdges::Edge edge = edges[e];
    if (edge.sides.size() != 2) {
      graph.addBorder(edge.low);
      graph.addBorder(edge.high);
      continue;
    }
    const CornerId a = edge.sides[0], b = edge.sides[1];
    if (isCrease(normals[triangleOf(a).index()], normals[triangleOf(b).index()], creaseDegrees)) {
      graph.add(edge.low, edge.high);
      ++lines.edges;
    } else {
      sectors.join(a, nextCorner(b));
      sectors.join(nextCorner(a), b);
    }
  }
  if (lines.edges == 0) return lines;
  lines.fixed = graph.fixed();
  divideWedges(mesh, sectors);
  return lines;
}

}  // namespace arete
