// SPDX-License-Identifier: GPL-3.0-or-later
//
// Boxes of edges against boxes of vertices [ZomorodianEdelsbrunner2000]; a pair whose boxes meet is measured.
// The distance is that of a point from a segment in doubles, so that it is certain to a few ulps of the
// coordinates.
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>

#include "surface/diagnosis/parts.h"

namespace arete::diagnosis {
namespace {

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

Box boxOf(Vec3 low, Vec3 high, double reach, std::uint32_t info) {
  const double from[] = {low.x - reach, low.y - reach, low.z - reach},
               to[] = {high.x + reach, high.y + reach, high.z + reach};
  return {CGAL::Bbox_3(from[0], from[1], from[2], to[0], to[1], to[2]), info};
}

bool isInside(const Vec3& p, const Vec3& a, const Vec3& b, double distance) {
  const Vec3 along = b - a;
  const double squared = dot(along, along);
  if (!(squared > 0)) return false;
  const double t = std::clamp(dot(p - a, along) / squared, 0.0, 1.0);
  return norm(p - (a + along * t)) <= distance && norm(p - a) > distance && norm(p - b) > distance;
}

}  // namespace

std::vector<TJunction> findTJunctions(std::span<const Vec3> positions,
                                      std::span<const std::array<std::uint32_t, 2>> edges,
                                      std::span<const std::uint32_t> vertices, double distance) {
  std::vector<Box> edgeBoxes, vertexBoxes;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    const Vec3 &a = positions[edges[e][0]], &b = positions[edges[e][1]];
    edgeBoxes.push_back(boxOf({std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
                              {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}, distance, e));
  }
  for (const std::uint32_t v : vertices) vertexBoxes.push_back(boxOf(positions[v], positions[v], 0, v));
  std::vector<TJunction> found;
  CGAL::box_intersection_d(edgeBoxes.begin(), edgeBoxes.end(), vertexBoxes.begin(), vertexBoxes.end(),
                           [&](const Box& edge, const Box& vertex) {
                             const auto [low, high] = edges[edge.info()];
                             const std::uint32_t v = vertex.info();
                             if (v == low || v == high) return;
                             if (isInside(positions[v], positions[low], positions[high], distance))
                               found.push_back({v, low, high});
                           });
  std::ranges::sort(found);
  return found;
}

}  // namespace arete::diagnosis
