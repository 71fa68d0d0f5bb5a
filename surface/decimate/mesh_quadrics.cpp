// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/decimate/mesh_quadrics.h"

#include <algorithm>

namespace arete {
bool isLine(const SurfaceMesh& source, const std::vector<std::uint32_t>& partOf,
            const MeshEdges::Edge& edge) {
  if (edge.sides.size() != 2) return false;
  const std::uint32_t s = triangleOf(edge.sides[0]).index(), t = triangleOf(edge.sides[1]).index();
  if (!partOf.empty() && partOf[s] != partOf[t]) return true;
  if (!source.hasWedges()) return false;
  for (const std::uint32_t v : {edge.low.index(), edge.high.index()}) {
    const auto wedgeAt = [&](std::uint32_t of) {
      const auto& corners = source.triangles[of];
      return source.wedges[of][static_cast<std::size_t>(std::ranges::find(corners, v) - corners.begin())];
    };
    if (wedgeAt(s) != wedgeAt(t)) return true;
  }
  return false;
}

MeshQuadrics quadricsOf(const SurfaceMesh& source, const TriangleMesh& shape,
                        const std::vector<std::uint32_t>& partOf, bool weighsByArea) {
  const auto& triangles = shape.triangles;
  const auto& at = shape.positions;
  MeshQuadrics result{std::vector<Quadric>(at.size()), std::vector<std::uint8_t>(at.size(), 0)};
  std::vector<Quadric>& quadrics = result.ofVertex;
  std::vector<Vec3> normals(triangles.size(), Vec3{0, 0, 0});
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto& [i, j, k] = triangles[t];
    const Vec3 n = cross(at[j] - at[i], at[k] - at[i]);
    const double size = norm(n);
    if (!(size > 0)) continue;
    normals[t] = n / size;
    const Quadric quadric = Quadric::ofPlane(at[i], normals[t], weighsByArea ? size / 2 : 1);
    for (const std::uint32_t v : triangles[t]) quadrics[v] += quadric;
  }
  const MeshEdges edges(triangles, at.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const MeshEdges::Edge edge = edges[e];
    const std::uint32_t a = edge.low.index(), b = edge.high.index();
    if (edge.isBorder()) result.isOnBorder[a] = result.isOnBorder[b] = 1;
    if (!edge.isBorder() && !isLine(source, partOf, edge)) continue;
    const Vec3 along = at[b] - at[a];
    for (const CornerId side : edge.sides) {
      const Vec3 across = cross(along, normals[triangleOf(side).index()]);
      if (!(norm(across) > 0)) continue;
      const Quadric quadric = Quadric::ofPlane(at[a], unit(across), weighsByArea ? dot(along, along) : 1);
      quadrics[a] += quadric;
      quadrics[b] += quadric;
    }
  }
  return result;
}

}  // namespace arete
