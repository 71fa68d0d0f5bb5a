// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ground is bent onto a sphere whose map is known, and the bound is checked at random points of
// triangles.
#include "engine/mt/curved_mt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/base/vec.h"
#include "engine/family_models.h"

namespace arete {
namespace {

/// Along a parabola of the given radius at the top: M(x, y, h) = (x, y, h - (x^2 + y^2) / 2 R). Its second
/// derivative is 1 / R in every direction, and the vertical does not turn.
Vec3 onParabola(const Vec3& p, double radius) {
  return {p.x, p.y, p.z - (p.x * p.x + p.y * p.y) / (2 * radius)};
}

/// The image of a point on a sphere that touches the plan at the origin: along the arc, then up.
Vec3 onSphere(const Vec3& p, double radius) {
  const double length = std::hypot(p.x, p.y), angle = length / radius;
  if (length == 0) return p;
  const double out = (radius + p.z) * std::sin(angle) / length;
  return {p.x * out, p.y * out, (radius + p.z) * std::cos(angle) - radius};
}

TEST(CurvedMt, BoundsHowFarAParabolaLeavesATrianglesPlane) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  double tightest = 0;
  for (int round = 0; round < 2000; ++round) {
    const double radius = 100, size = std::pow(10, 1.5 * unit(random));
    Vec3 flat[3], bent[3];
    for (int i = 0; i < 3; ++i) {
      flat[i] = {size * unit(random), size * unit(random), 10 * unit(random)};
      bent[i] = onParabola(flat[i], radius);
    }
    Bending bending;
    bending.curvature = 1 / radius;
    const double bound = curvedAway(bending, flat[0], flat[1], flat[2]);
    for (int sample = 0; sample < 30; ++sample) {
      double w[3] = {1 + unit(random), 1 + unit(random), 1 + unit(random)};
      const double sum = w[0] + w[1] + w[2];
      Vec3 there{}, straight{};
      for (int i = 0; i < 3; ++i) {
        there = there + (w[i] / sum) * flat[i];
        straight = straight + (w[i] / sum) * bent[i];
      }
      const double miss = norm(onParabola(there, radius) - straight);
      EXPECT_LE(miss, bound * (1 + 1e-9) + 1e-12);
      tightest = std::max(tightest, miss / bound);
    }
  }
  EXPECT_GT(tightest, 0.8);
}

TEST(CurvedMt, BoundsHowFarASphereLeavesATrianglesPlane) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int round = 0; round < 2000; ++round) {
    const double radius = 1000, size = 200, high = 20;
    Vec3 flat[3], bent[3];
    const Vec3 middle{400 * unit(random), 400 * unit(random), 0};
    for (int i = 0; i < 3; ++i) {
      flat[i] = {middle.x + size * unit(random), middle.y + size * unit(random), high * unit(random)};
      bent[i] = onSphere(flat[i], radius);
    }
    Bending bending;
    bending.curvature = 1.1 * (radius + high) / (radius * radius);
    bending.turning = 1.1 / radius;
    const double bound = curvedAway(bending, flat[0], flat[1], flat[2]);
    for (int sample = 0; sample < 10; ++sample) {
      double w[3] = {1 + unit(random), 1 + unit(random), 1 + unit(random)};
      const double sum = w[0] + w[1] + w[2];
      Vec3 there{}, straight{};
      for (int i = 0; i < 3; ++i) {
        there = there + (w[i] / sum) * flat[i];
        straight = straight + (w[i] / sum) * bent[i];
      }
      EXPECT_LE(norm(onSphere(there, radius) - straight), bound);
    }
  }
}

TEST(CurvedMt, GrowsErrorsKeepsLaw6AndTheTopology) {
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    const MetricFrame& metric = mt.arrays().metric;
    Bending bending;
    bending.flat = bending.metric = metric;
    bending.metric.scale.x = bending.metric.scale.y = 1;
    bending.metric.origin = {};
    const double radius = 500;
    for (std::uint32_t v = 0; v < mt.vertexCount(); ++v) {
      const Vec3 p = onParabola(metric.toMetric(mt.position(VertexId(v))), radius);
      bending.plan.push_back({p.x, p.y});
      bending.heights.push_back(p.z / bending.metric.scale.z);
    }
    bending.curvature = 1 / radius;
    const MultiTriangulation made = curved(mt, bending);
    const MtArrays &a = made.arrays(), &before = mt.arrays();
    EXPECT_TRUE(std::ranges::equal(a.link, before.link)) << m.name;
    EXPECT_TRUE(std::ranges::equal(a.remover, before.remover)) << m.name;
    EXPECT_TRUE(a.columns.of(kBelow).empty() && a.columns.of(kAbove).empty()) << m.name;
    for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t) {
      if (mt.remover(TriangleId(t)).isValid() && mt.remover(TriangleId(t)) == mt.creator(TriangleId(t)))
        continue;  // the last slot of an open star
      ASSERT_GE(made.error(TriangleId(t)), mt.error(TriangleId(t))) << m.name;
    }
    for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) {
      const NodeId node(n);
      for (const std::uint32_t t : made.floor(node)) ASSERT_LE(a.error[t], a.saturatedError[n]) << m.name;
      const Sphere& ball = a.sphere[n];
      const auto distance = [&](const Vec3& p) { return norm(p - Vec3{ball.x, ball.y, ball.z}); };
      ASSERT_LE(distance(a.metric.toMetric(made.position(made.apex(node)))), ball.radius) << m.name;
      for (std::uint32_t i = 0; i < made.ceilingSize(node); ++i) {
        const NodeId child = made.remover(made.slotTriangle(node, i));
        if (!child.isValid()) continue;
        const Sphere& inner = a.sphere[child.index()];
        ASSERT_LE(a.saturatedError[child.index()], a.saturatedError[n]) << m.name;
        ASSERT_LE(distance({inner.x, inner.y, inner.z}) + inner.radius, ball.radius) << m.name;
      }
    }
  }
}

}  // namespace
}  // namespace arete
