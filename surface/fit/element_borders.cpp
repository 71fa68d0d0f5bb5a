// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/fit/element_borders.h"

#include <algorithm>
#include <tuple>

#include "surface/topology/edges.h"

namespace arete {

std::vector<std::array<std::uint32_t, 3>> elementsOf(const SurfaceMesh& mesh, bool areWedges) {
  return areWedges ? mesh.wedges : mesh.triangles;
}

std::vector<std::uint32_t> verticesOfElements(const SurfaceMesh& mesh,
                                              std::span<const std::array<std::uint32_t, 3>> elements,
                                              std::size_t count) {
  std::vector<std::uint32_t> vertexOf(count, MeshAttributes::kNone);
  for (std::size_t t = 0; t < elements.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) vertexOf[elements[t][c]] = mesh.triangles[t][c];
  return vertexOf;
}

ElementBorders::ElementBorders(std::span<const std::array<std::uint32_t, 3>> elements,
                               const std::vector<std::uint32_t>& vertexOf, const std::vector<Vec3>& positions)
    : vertexOf_(vertexOf),
      positions_(positions),
      neighbours_(vertexOf.size(), {kNone, kNone}),
      degree_(vertexOf.size(), 0) {
  const MeshEdges edges(elements, vertexOf.size());
  const auto add = [&](std::uint32_t a, std::uint32_t b) {
    if (degree_[a] < 2) neighbours_[a][degree_[a]] = b;
    ++degree_[a];
  };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (!edges[e].isBorder()) continue;
    add(edges[e].low.index(), edges[e].high.index());
    add(edges[e].high.index(), edges[e].low.index());
  }
}

ElementBorders::Place ElementBorders::nearest(std::uint32_t element, const Vec3& p) const {
  const double reach = 4 * norm(p - at(element));
  Place best{element, element, 0};
  double least = dot(p - at(element), p - at(element));
  for (const std::uint32_t beginning : neighbours_[element]) {
    std::uint32_t from = element, to = beginning;
    double length = 0;
    for (;;) {
      // Both sides of a seam divide a segment in the same order, so that they round alike.
      std::uint32_t a = from, b = to;
      const auto key = [&](std::uint32_t e) { return std::tuple(at(e).x, at(e).y, at(e).z); };
      if (key(b) < key(a)) std::swap(a, b);
      const Vec3 along = at(b) - at(a);
      const double squared = dot(along, along);
      const double share = squared > 0 ? std::clamp(dot(p - at(a), along) / squared, 0.0, 1.0) : 0;
      const Vec3 off = p - (at(a) + share * along);
      if (dot(off, off) < least) {
        least = dot(off, off);
        best = {a, b, share};
      }
      length += norm(along);
      if (length > reach || to == element || !passes(to)) break;
      const std::uint32_t next = neighbours_[to][0] == from ? neighbours_[to][1] : neighbours_[to][0];
      from = to;
      to = next;
    }
  }
  return best;
}

}  // namespace arete
