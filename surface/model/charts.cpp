// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/model/charts.h"

#include <algorithm>
#include <span>

#include "surface/topology/disjoint_sets.h"
#include "surface/topology/edges.h"

namespace arete {
namespace {

using Corners = std::array<std::uint32_t, 3>;

/// @param labelsAt of triangle i
template <class LabelsAt>
std::vector<std::uint32_t> chartsOf(std::span<const Corners> triangles, std::size_t vertices,
                                    const SurfaceParts& parts, const LabelsAt& labelsAt) {
  const MeshEdges edges(triangles, vertices);
  DisjointSets sets(triangles.size());
  const auto wedgeAt = [&](const TriangleLabels& labels, std::uint32_t t, VertexId v) {
    const Corners& corners = triangles[t];
    return labels.wedges[static_cast<std::size_t>(std::ranges::find(corners, v.index()) - corners.begin())];
  };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const MeshEdges::Edge edge = edges[e];
    const std::uint32_t s = triangleOf(edge.sides[0]).index();
    const TriangleLabels first = labelsAt(s);
    for (const CornerId side : edge.sides.subspan(1)) {
      const std::uint32_t t = triangleOf(side).index();
      const TriangleLabels second = labelsAt(t);
      const auto agreeAt = [&](VertexId v) { return wedgeAt(first, s, v) == wedgeAt(second, t, v); };
      if (parts.areAlike(first, second) && agreeAt(edge.low) && agreeAt(edge.high)) sets.unite(s, t);
    }
  }
  std::uint32_t count = 0;
  const auto numbered = sets.numbered(count);
  return {numbered.begin(), numbered.end()};
}

}  // namespace

std::vector<std::uint32_t> chartsOf(const SurfaceMesh& mesh) {
  const std::vector<std::uint32_t> partOf = partsOf(mesh, mesh.triangles.size());
  const SurfaceParts parts{mesh.hasWedges(), partOf};
  if (!parts.hasLines()) return {};
  return chartsOf(mesh.triangles, mesh.positions.size(), parts, [&](std::uint32_t t) {
    return TriangleLabels{t, mesh.hasWedges() ? mesh.wedges[t] : Corners{}};
  });
}

std::vector<std::uint32_t> chartsOf(const SurfaceModel& model) {
  if (!model.boundsLines) return {};
  const MultiTriangulation& mt = model.mt;
  std::vector<Corners> triangles;
  std::vector<std::uint32_t> ids;
  for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t) {
    if (mt.remover(TriangleId(t)).isValid()) continue;
    triangles.push_back(mt.corners(TriangleId(t)));
    ids.push_back(t);
  }
  std::vector<std::uint32_t> partOf;
  const SurfaceParts parts = partsOf(model, partOf);
  const std::vector<std::uint32_t> ofFinest =
      chartsOf(triangles, mt.vertexCount(), parts, [&](std::uint32_t i) {
        return TriangleLabels{model.faceOf[ids[i]], model.hasWedges() ? model.wedgesOf[ids[i]] : Corners{}};
      });
  std::vector<std::uint32_t> charts(mt.triangleIdCount(), 0);
  for (std::size_t i = 0; i < ids.size(); ++i) charts[ids[i]] = ofFinest[i];
  // Each triangle of a floor has an edge in common with one of the star on its side of a line.
  for (std::uint32_t n = mt.nodeCount(); n-- > 0;) {
    const NodeId node(n);
    const auto link = mt.link(node);
    const auto slotAt = [&](int i) { return mt.slotTriangle(node, static_cast<std::uint32_t>(i)).index(); };
    const auto size = static_cast<int>(mt.ceilingSize(node));
    const StarLine line = lineThrough(parts, size, mt.isOpen(node), [&](int i) {
      return TriangleLabels{model.faceOf[slotAt(i)],
                            model.hasWedges() ? model.wedgesOf[slotAt(i)] : Corners{}};
    });
    for (const std::uint32_t t : mt.floor(node)) {
      const Corners corners = mt.corners(TriangleId(t));
      std::array<int, 3> at{};
      for (std::size_t c = 0; c < 3; ++c)
        at[c] = static_cast<int>(std::ranges::find(link, corners[c]) - link.begin());
      const auto isCorner = [&](int i) { return std::ranges::find(at, i) != at.end(); };
      int heir = -1, best = -1;
      for (int i = 0; i < size; ++i) {
        if (line.sideOfStar(i) != line.sideOf(at)) continue;
        const int common = int(isCorner(i)) + int(isCorner((i + 1) % static_cast<int>(link.size())));
        if (common > best) best = common, heir = i;
      }
      if (heir >= 0) charts[t] = charts[slotAt(heir)];
    }
  }
  return charts;
}

SurfaceParts partsOf(const SurfaceModel& model, std::vector<std::uint32_t>& partOf) {
  partOf = partsOf(model.attributes, std::size_t{model.faceCount()});
  return {model.hasWedges(), partOf};
}

}  // namespace arete
