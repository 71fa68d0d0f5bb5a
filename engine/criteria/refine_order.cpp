// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles in sight are ranked by their distance from the eye, others by the vertex that refines them.
#include "engine/criteria/refine_order.h"

#include <cmath>

#include "engine/base/nearest_on_triangle.h"
#include "engine/criteria/view_error.h"
#include "engine/mt/enclosing_ball.h"

namespace arete {

namespace {

/// False if nothing that the triangle stands for is in sight.
bool maySee(const Frustum& frustum, const MultiTriangulation& mt, TriangleId t,
            const Criterion::Corners& corners) {
  if (mt.vertices().hasPlan()) {
    std::array<Vec3, 6> prism = prismOf(mt, t, corners);
    for (Vec3& p : prism) p = frustum.toView(p);
    return frustum.mayMeet(prism);
  }
  // It stands for what is within its error.
  const auto at = [&](std::size_t i) { return mt.metric().toMetric(mt.position(VertexId(corners[i]))); };
  const std::array<Vec3, 3> places{at(0), at(1), at(2)};
  const EnclosingBall ball = EnclosingBall::around(places);
  const double radius = (ball.radius + mt.error(t)) * (1 + 1e-9);
  return frustum.mayMeet(frustum.toView({ball.x, ball.y, ball.z}), radius);
}

}  // namespace

RefineKey TwoQueues::key(const MultiTriangulation& mt, const Criterion&, TriangleId t,
                         const Criterion::Corners& corners, std::uint64_t) const {
  if (maySee(frustum_, mt, t, corners)) {
    const MetricFrame& metric = mt.metric();
    const auto corner = [&](int i) { return metric.toMetric(mt.position(VertexId(corners[i]))); };
    return {0, distanceToTriangle(o_.view.eye, {corner(0), corner(1), corner(2)})};
  }
  const NodeId remover = mt.remover(t);
  if (!remover.isValid()) return {1, 0};
  const Vec3 p = frustum_.toView(mt.metric().toMetric(mt.position(mt.apex(remover))));
  const double fromAxis = std::hypot(p.x, p.y), fromEye = std::hypot(fromAxis, p.z);
  const double sum = o_.axisWeight * fromAxis + o_.distanceWeight * fromEye;
  return {1, p.z < 0 ? sum * o_.behindFactor : sum};
}

}  // namespace arete
