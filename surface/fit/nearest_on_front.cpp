// SPDX-License-Identifier: GPL-3.0-or-later
//
// Trees of boxes [CGAL] with doubles: a nearest point that is off by a rounding serves a fit as well.
#include "surface/fit/nearest_on_front.h"

#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>

#include "engine/base/triangle_shares.h"

namespace arete {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using TriangleList = std::vector<Kernel::Triangle_3>;
using SegmentList = std::vector<Kernel::Segment_3>;
using TriangleTree = CGAL::AABB_tree<
    CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, TriangleList::const_iterator>>>;
using SegmentTree = CGAL::AABB_tree<
    CGAL::AABB_traits<Kernel, CGAL::AABB_segment_primitive<Kernel, SegmentList::const_iterator>>>;

Kernel::Point_3 pointOf(const Vec3& p) {
  return {p.x, p.y, p.z};
}
Vec3 vecOf(const Kernel::Point_3& p) {
  return {p.x(), p.y(), p.z()};
}

}  // namespace

struct NearestOnFront::Triangles {
  TriangleList triangles;
  std::vector<std::uint32_t> numberOf;
  TriangleTree tree;
};
struct NearestOnFront::Edges {
  SegmentList segments;
  std::vector<std::uint32_t> numberOf;
  SegmentTree tree;
};

NearestOnFront::NearestOnFront(std::span<const Vec3> positions,
                               std::span<const std::array<std::uint32_t, 3>> triangles)
    : triangles_(std::make_unique<Triangles>()) {
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const Vec3 &a = positions[triangles[t][0]], &b = positions[triangles[t][1]],
               &c = positions[triangles[t][2]];
    const Vec3 n = cross(b - a, c - a);
    if (!(dot(n, n) > 0)) continue;
    triangles_->triangles.emplace_back(pointOf(a), pointOf(b), pointOf(c));
    triangles_->numberOf.push_back(t);
  }
  triangles_->tree.insert(triangles_->triangles.cbegin(), triangles_->triangles.cend());
  triangles_->tree.build();
  triangles_->tree.accelerate_distance_queries();
}

NearestOnFront::NearestOnFront(std::span<const Vec3> positions,
                               std::span<const std::array<std::uint32_t, 2>> edges)
    : edges_(std::make_unique<Edges>()) {
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    const Vec3 &a = positions[edges[e][0]], &b = positions[edges[e][1]];
    if (!(dot(b - a, b - a) > 0)) continue;
    edges_->segments.emplace_back(pointOf(a), pointOf(b));
    edges_->numberOf.push_back(e);
  }
  edges_->tree.insert(edges_->segments.cbegin(), edges_->segments.cend());
  edges_->tree.build();
  edges_->tree.accelerate_distance_queries();
}

NearestOnFront::~NearestOnFront() = default;

bool NearestOnFront::isEmpty() const {
  return triangles_ ? triangles_->triangles.empty() : edges_->segments.empty();
}

FrontPoint NearestOnFront::nearest(const Vec3& p) const {
  if (triangles_) {
    const auto [point, at] = triangles_->tree.closest_point_and_primitive(pointOf(p));
    const auto& t = *at;
    return {triangles_->numberOf[static_cast<std::size_t>(at - triangles_->triangles.cbegin())],
            sharesAt(vecOf(point), {vecOf(t[0]), vecOf(t[1]), vecOf(t[2])})};
  }
  const auto [point, at] = edges_->tree.closest_point_and_primitive(pointOf(p));
  const Vec3 a = vecOf(at->source()), d = vecOf(at->target()) - a;
  const double share = std::clamp(dot(vecOf(point) - a, d) / dot(d, d), 0.0, 1.0);
  return {edges_->numberOf[static_cast<std::size_t>(at - edges_->segments.cbegin())], {1 - share, share, 0}};
}

}  // namespace arete
