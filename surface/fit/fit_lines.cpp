// SPDX-License-Identifier: GPL-3.0-or-later
//
// A cut keeps the vertices of a line that it needs, so between two that follow each other in the cut the line
// of the source runs through vertices that the cut has not. From each end it is followed until it meets
// a vertex of the cut.
#include "surface/fit/fit_lines.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "surface/model/parts.h"
#include "surface/topology/edges.h"

namespace arete {
namespace {

constexpr std::uint32_t kNoVertex = MeshAttributes::kNone;

/// The lines at the vertices of a mesh.
struct LinesAt {
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<std::array<std::uint32_t, 2>> neighbours;  ///< by vertex: along lines
  std::vector<std::uint32_t> degree;                     ///< by vertex; borders count as branches

  explicit LinesAt(const SurfaceMesh& mesh)
      : neighbours(mesh.positions.size(), {kNoVertex, kNoVertex}), degree(mesh.positions.size(), 0) {
    const std::vector<std::uint32_t> parts = partsOf(mesh, mesh.triangles.size());
    if (!mesh.hasWedges() && parts.empty()) return;
    const MeshEdges all(mesh.triangles, mesh.positions.size());
    const auto cornerAt = [&](CornerId side, VertexId v) {
      return all.origin(side) == v ? side : nextCorner(side);
    };
    const auto wedgeAt = [&](CornerId side, VertexId v) {
      const CornerId corner = cornerAt(side, v);
      return mesh.wedges[corner.index() / 3][corner.index() % 3];
    };
    for (std::size_t e = 0; e < all.size(); ++e) {
      const MeshEdges::Edge edge = all[e];
      const std::uint32_t low = edge.low.index(), high = edge.high.index();
      if (edge.sides.size() != 2) {
        degree[low] += 3;
        degree[high] += 3;
        continue;
      }
      const CornerId a = edge.sides[0], b = edge.sides[1];
      const bool differs = (!parts.empty() && parts[triangleOf(a).index()] != parts[triangleOf(b).index()]) ||
                           (mesh.hasWedges() && (wedgeAt(a, edge.low) != wedgeAt(b, edge.low) ||
                                                 wedgeAt(a, edge.high) != wedgeAt(b, edge.high)));
      if (!differs) continue;
      edges.push_back({low, high});
      add(low, high);
      add(high, low);
    }
  }
  bool passes(std::uint32_t v) const { return degree[v] == 2; }
  /// The neighbour of a vertex that a line passes, from another neighbour.
  std::uint32_t beyond(std::uint32_t v, std::uint32_t from) const {
    return neighbours[v][0] == from ? neighbours[v][1] : neighbours[v][0];
  }

 private:
  void add(std::uint32_t v, std::uint32_t to) {
    if (degree[v] < 2) neighbours[v][degree[v]] = to;
    ++degree[v];
  }
};

}  // namespace

FitLines fitLines(const SurfaceMesh& cut, const SurfaceMesh& source) {
  FitLines lines;
  const LinesAt ofCut(cut);
  if (ofCut.edges.empty()) return lines;
  const LinesAt ofSource(source);
  // Vertices of the source at lines, by place: kNoVertex where there are several.
  const auto keyOf = [](const Vec3& p) { return std::tuple(p.x, p.y, p.z); };
  std::map<std::tuple<double, double, double>, std::uint32_t> sourceAt;
  for (std::uint32_t v = 0; v < source.positions.size(); ++v)
    if (ofSource.degree[v] > 0)
      if (const auto [at, isNew] = sourceAt.emplace(keyOf(source.positions[v]), v); !isNew)
        at->second = kNoVertex;
  std::vector<std::uint32_t> sourceOf(cut.positions.size(), kNoVertex),
      cutOf(source.positions.size(), kNoVertex);
  for (std::uint32_t v = 0; v < cut.positions.size(); ++v) {
    if (ofCut.degree[v] == 0) continue;
    const auto found = sourceAt.find(keyOf(cut.positions[v]));
    if (found == sourceAt.end() || found->second == kNoVertex) continue;
    sourceOf[v] = found->second;
    cutOf[found->second] = v;
  }
  lines.mayMove.assign(cut.positions.size(), 0);
  for (std::uint32_t v = 0; v < cut.positions.size(); ++v)
    lines.mayMove[v] = ofCut.passes(v) && sourceOf[v] != kNoVertex && ofSource.passes(sourceOf[v]) ? 1 : 0;

  const auto wayAlong = [&](std::uint32_t first, std::uint32_t second) {
    std::vector<Vec3> way;
    int found = 0;
    const std::uint32_t begin = sourceOf[first];
    if (begin == kNoVertex) return way;
    for (const std::uint32_t beginning : ofSource.neighbours[begin]) {
      if (beginning == kNoVertex) continue;
      std::vector<Vec3> places = {source.positions[begin]};
      std::uint32_t from = begin, at = beginning;
      for (; cutOf[at] == kNoVertex && ofSource.passes(at) && at != begin;) {
        places.push_back(source.positions[at]);
        from = std::exchange(at, ofSource.beyond(at, from));
      }
      if (cutOf[at] != second) continue;
      places.push_back(source.positions[at]);
      way = std::move(places);
      ++found;
    }
    return found == 1 ? way : std::vector<Vec3>();
  };
  std::vector<std::vector<Vec3>> ways;
  for (const auto& [a, b] : ofCut.edges) {
    // From an end that a line passes, of which all neighbours are known.
    const bool isTurned = lines.mayMove[a] == 0;
    ways.push_back({});
    if (lines.mayMove[a] != 0 || lines.mayMove[b] != 0)
      ways.back() = isTurned ? wayAlong(b, a) : wayAlong(a, b);
    if (isTurned) std::ranges::reverse(ways.back());
    if (ways.back().empty()) lines.mayMove[a] = lines.mayMove[b] = 0;
  }
  std::vector<std::array<std::uint32_t, 2>> edgesAt(cut.positions.size(), {kNoVertex, kNoVertex});
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const auto& [a, b] = ofCut.edges[i];
    if (lines.mayMove[a] == 0 && lines.mayMove[b] == 0) continue;
    const auto number = static_cast<std::uint32_t>(lines.edges.size());
    for (const std::uint32_t v : {a, b})
      if (lines.mayMove[v] != 0) edgesAt[v][edgesAt[v][0] == kNoVertex ? 0 : 1] = number;
    lines.edges.push_back({{a, b}, {kNoVertex, kNoVertex}, std::move(ways[i])});
  }
  for (std::uint32_t e = 0; e < lines.edges.size(); ++e)
    for (std::size_t end = 0; end < 2; ++end) {
      const std::uint32_t v = lines.edges[e].ends[end];
      if (lines.mayMove[v] != 0)
        lines.edges[e].next[end] = edgesAt[v][0] == e ? edgesAt[v][1] : edgesAt[v][0];
    }
  return lines;
}

}  // namespace arete
