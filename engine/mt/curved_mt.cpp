// SPDX-License-Identifier: GPL-3.0-or-later
//
// A map M takes a point p of the plan at height h to B(p) + h U(p), U a unit vector. Let (p, h) be the point
// of a triangle with the corners (p_i, h_i) at weights l_i. The plane through the images of the corners
// misses M(p, h) by
//
//     sum l_i M(p_i, h_i) - M(p, h) = sum l_i M''[d_i, d_i] / 2,    d_i = (p_i - p, h_i - h),
//
// M'' at some point between p and each corner. That is at most
//
//     sum l_i (C |p_i - p|^2 + 2 T |p_i - p| |h_i - h|) / 2,
//
// where C bounds M'' along the plan and T the derivative of U; along h there is none. Now sum l_i |p_i - p|^2
// is at most r^2, r the radius of the smallest circle around the corners, and sum l_i |h_i - h|^2, a
// variance, is at most a quarter of the squared range R of the heights. So by Cauchy and Schwarz the distance
// is at most C r^2 / 2 + T r R / 2. On a sphere the first term is the sag of the chord. A sample lies e above
// or below (p, h), and so does its image, along U: the whole distance is at most the sum.
#include "engine/mt/curved_mt.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/mt/node_blocks.h"
#include "engine/mt/saturated_balls.h"
#include "engine/parallel/parallel_loops.h"

namespace arete {
namespace {

constexpr double kRounding = 1 + 1e-9;

struct CurvedOwner {
  MultiTriangulation original;
  Bending bending;
  std::vector<OutwardScale::Code> error, saturatedError;
  std::vector<Sphere> sphere;
  NodeBlocks blocks;
};

/// Squared radius of the smallest circle around a triangle of the plan.
double squaredRadius(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto squared = [](const Vec3& p, const Vec3& q) {
    return (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y);
  };
  const double ab = squared(a, b), bc = squared(b, c), ca = squared(c, a);
  const double longest = std::max({ab, bc, ca});
  if (ab + bc + ca <= 2 * longest) return longest / 4;  // obtuse, or right
  const double twiceArea = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  // Acute: its area is at least that of half an isosceles right triangle, and the division is safe.
  return ab * bc * ca / (4 * twiceArea * twiceArea);
}

/// Calls each(id, error) with the curved error of every triangle, in units of height; parallel over nodes.
template <class Each>
void forEachTriangle(const MultiTriangulation& mt, const Bending& bending, const Each& each) {
  const auto place = [&](std::uint32_t v) { return bending.flat.toMetric(mt.position(VertexId(v))); };
  const double unit = bending.metric.scale.z;
  const auto errorOf = [&](TriangleId t, const Vec3& a, const Vec3& b, const Vec3& c) {
    return (mt.error(t) + curvedAway(bending, a, b, c) / unit) * kRounding;
  };
  for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t) {
    const auto corners = mt.arrays().rootTriangles[t];
    each(t, errorOf(TriangleId(t), place(corners[0]), place(corners[1]), place(corners[2])));
  }
  parallelFor(IndexRange<std::uint32_t>(0, mt.nodeCount(), 1024), [&](const auto& range) {
    std::vector<Vec3> link;
    for (std::uint32_t n = range.begin(); n < range.end(); ++n) {
      const NodeId node(n);
      link.clear();
      for (const std::uint32_t v : mt.link(node)) link.push_back(place(v));
      const Vec3 apex = place(mt.apex(node).index());
      for (std::uint32_t i = 0; i < mt.ceilingSize(node); ++i) {
        const TriangleId t = mt.slotTriangle(node, i);
        each(t.index(), errorOf(t, apex, link[i], link[(i + 1) % link.size()]));
      }
    }
  });
}

/// An upper bound of all triangles' curved errors.
double boundOfErrors(const MultiTriangulation& mt, const Bending& bending) {
  Vec3 low = bending.flat.toMetric(mt.position(VertexId(0))), high = low;
  for (std::uint32_t v = 1; v < mt.vertexCount(); ++v) {
    const Vec3 p = bending.flat.toMetric(mt.position(VertexId(v)));
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double diagonal = std::hypot(high.x - low.x, high.y - low.y);
  const auto& errors = mt.arrays().error;
  const double largest = errors.empty() ? 0 : mt.arrays().scale.decode(std::ranges::max(errors));
  // A circle around what is in the box is at most as large as the one around an equilateral triangle in it.
  const double bend =
      bending.curvature * diagonal * diagonal / 6 + bending.turning * diagonal * (high.z - low.z) / 3;
  return (largest + bend / bending.metric.scale.z) * kRounding * kRounding;
}

/// Children first: the largest error of a node's floor and of its children.
std::vector<OutwardScale::Code> saturatedErrors(const MultiTriangulation& mt,
                                                std::span<const OutwardScale::Code> errors) {
  std::vector<OutwardScale::Code> saturated(mt.nodeCount());
  for (std::uint32_t n = mt.nodeCount(); n-- > 0;) {
    const NodeId node(n);
    OutwardScale::Code error = 0;
    for (const std::uint32_t t : mt.floor(node)) error = std::max(error, errors[t]);
    for (std::uint32_t i = 0; i < mt.ceilingSize(node); ++i)
      if (const NodeId child = mt.remover(mt.slotTriangle(node, i)); child.isValid())
        error = std::max(error, saturated[child.index()]);
    saturated[n] = error;
  }
  return saturated;
}

}  // namespace

double curvedAway(const Bending& bending, const Vec3& a, const Vec3& b, const Vec3& c) {
  const double square = squaredRadius(a, b, c);
  const double rise = std::max({a.z, b.z, c.z}) - std::min({a.z, b.z, c.z});
  return (bending.curvature * square + bending.turning * std::sqrt(square) * rise) / 2;
}

MultiTriangulation curved(const MultiTriangulation& mt, Bending bending) {
  assert(bending.plan.size() == mt.vertexCount() && bending.heights.size() == mt.vertexCount());
  assert(bending.curvature >= 0 && bending.turning >= 0 && bending.metric.scale.z > 0);
  auto owner = std::make_shared<CurvedOwner>();
  owner->original = mt;
  owner->bending = std::move(bending);
  MtArrays a = mt.arrays();
  a.metric = owner->bending.metric;
  a.vertices = {};
  a.vertices.plan = owner->bending.plan;
  a.vertices.rawHeights = std::as_bytes(std::span<const double>(owner->bending.heights));
  a.columns.drop(kBelow);
  a.columns.drop(kAbove);

  a.scale = OutwardScale(mt.vertexCount() == 0 ? 0 : boundOfErrors(mt, owner->bending));
  owner->error.resize(a.error.size());
  forEachTriangle(mt, owner->bending,
                  [&](std::uint32_t t, double error) { owner->error[t] = a.scale.encode(error); });
  const Bending& b = owner->bending;
  owner->sphere = saturatedBalls(mt, [&](std::uint32_t v) {
    return b.metric.toMetric({b.plan[v].x, b.plan[v].y, b.heights[v]});
  });
  owner->saturatedError = saturatedErrors(mt, owner->error);
  owner->blocks = makeNodeBlocks(owner->saturatedError, owner->sphere);
  a.error = owner->error;
  a.saturatedError = owner->saturatedError;
  a.sphere = owner->sphere;
  a.blockSphere = owner->blocks.sphere;
  a.blockError = owner->blocks.error;
  return MultiTriangulation(a, owner);
}

}  // namespace arete
