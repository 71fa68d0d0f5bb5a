// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "engine/criteria/combined.h"
#include "engine/criteria/view_error.h"
#include "engine/cut/cut.h"
#include "engine/laws/validate.h"

namespace arete {

/// The box of an MT's vertices, in plan coordinates and in metric space.
struct Extent {
  Box2 plan;
  Vec3 low, high;  // metric

  explicit Extent(const MultiTriangulation& mt) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    plan = {kInfinity, kInfinity, -kInfinity, -kInfinity};
    low = {kInfinity, kInfinity, kInfinity};
    high = {-kInfinity, -kInfinity, -kInfinity};
    for (std::uint32_t v = 0; v < mt.vertexCount(); ++v) {
      const Vec3 p = mt.position(VertexId(v)), q = mt.arrays().metric.toMetric(p);
      plan = {std::min(plan.xMin, p.x), std::min(plan.yMin, p.y), std::max(plan.xMax, p.x),
              std::max(plan.yMax, p.y)};
      low = {std::min(low.x, q.x), std::min(low.y, q.y), std::min(low.z, q.z)};
      high = {std::max(high.x, q.x), std::max(high.y, q.y), std::max(high.z, q.z)};
    }
  }
  double size() const { return std::max({high.x - low.x, high.y - low.y, 1e-9}); }
  double relief() const { return std::max(high.z - low.z, 1e-9); }
};

/// A camera somewhere over, beside or inside the terrain, looking anywhere.
inline View randomView(const Extent& extent, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto between = [&](double low, double high) { return low + (high - low) * unit(random); };
  View view;
  view.eye = {between(extent.low.x - 0.2 * extent.size(), extent.high.x + 0.2 * extent.size()),
              between(extent.low.y - 0.2 * extent.size(), extent.high.y + 0.2 * extent.size()),
              between(extent.low.z, extent.high.z + extent.relief())};
  const double azimuth = between(0, 2 * M_PI), pitch = between(-1.2, 0.4);
  view.forward = {std::cos(pitch) * std::cos(azimuth), std::cos(pitch) * std::sin(azimuth), std::sin(pitch)};
  view.verticalFieldOfView = between(0.2, 1.8);
  view.widthPixels = between(200, 2000);
  view.heightPixels = between(200, 1200);
  return view;
}

struct NamedCriterion {
  std::string name;
  std::shared_ptr<const Criterion> criterion;
};

/// One of every kind that Arete has, made to the measure of an MT.
inline std::vector<NamedCriterion> criteriaFor(const MultiTriangulation& mt, std::mt19937_64& random) {
  const Extent e(mt);
  const MetricFrame& metric = mt.arrays().metric;
  const double span = mt.nodeCount() ? mt.largestError() : 1;
  const auto at = [&](double x, double y) {
    return Vec2{e.plan.xMin + x * (e.plan.xMax - e.plan.xMin), e.plan.yMin + y * (e.plan.yMax - e.plan.yMin)};
  };
  const auto uniform = std::make_shared<UniformError>(0.05 * span);
  const auto region = std::make_shared<RegionError>(Region({{at(0.2, 0.1), at(0.6, 0.2), at(0.4, 0.8)}}),
                                                    metric, 0.01 * span, 0.4 * span);
  const auto corridor = std::make_shared<RegionError>(
      Region({.lines = {{at(0, 0.2), at(0.5, 0.6), at(0.9, 0.5)}}, .distance = 0.07 * e.size()}, metric),
      metric, 0.005 * span, 0.5 * span);
  const Vec2 place = at(0.3, 0.7);
  const auto growing = std::make_shared<DistanceError>(
      DistanceError::Options{.place = metric.toMetric({place.x, place.y, metric.origin.z}),
                             .inPlan = true,
                             .nearError = 0.001 * span,
                             .growth = span / e.size(),
                             .farError = 0.3 * span});
  const auto view =
      std::make_shared<ViewError>(ViewError::Options{.view = randomView(e, random), .pixels = 2}, metric);
  const auto predicate = std::make_shared<Predicate>(
      [](const MultiTriangulation&, TriangleId t, const Criterion::Corners&) { return t.index() % 5 != 0; });
  return {{"uniform", uniform},
          {"region", region},
          {"corridor", corridor},
          {"distance", growing},
          {"view", view},
          {"predicate", predicate},
          {"all of region and view", allOf({region, view})},
          {"any of uniform and distance", anyOf({uniform, growing})},
          {"all of view and predicate", allOf({view, predicate})}};
}

/// The least closed set by plain iteration to a fixed point over all triangles: the oracle of minimal cuts.
inline NodeSet leastClosedSet(const MultiTriangulation& mt, const Criterion& criterion) {
  std::vector<std::uint8_t> fails(mt.triangleIdCount(), 0);
  for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t) {
    const NodeId creator = mt.creator(TriangleId(t)), remover = mt.remover(TriangleId(t));
    if (!remover.isValid() || creator == remover) continue;  // the finest, or no triangle
    fails[t] = isSatisfied(mt, criterion, TriangleId(t), mt.corners(TriangleId(t))) ? 0 : 1;
  }
  NodeSet in(mt.nodeCount(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    const auto include = [&](NodeId n) {
      if (!n.isValid() || in[n.index()]) return;
      in[n.index()] = 1;
      changed = true;
    };
    for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t) {
      const NodeId creator = mt.creator(TriangleId(t));
      if (fails[t] && (!creator.isValid() || in[creator.index()])) include(mt.remover(TriangleId(t)));
    }
    for (std::uint32_t n = 0; n < mt.nodeCount(); ++n)
      if (in[n])
        for (const std::uint32_t t : mt.floor(NodeId(n))) include(mt.creator(TriangleId(t)));
  }
  return in;
}

/// Every triangle of the front satisfies the criterion, or nothing is finer.
inline void expectMet(const MultiTriangulation& mt, const Criterion& criterion, const Cut& cut) {
  std::size_t unmet = 0;
  for (std::size_t i = 0; i < cut.ids.size(); ++i) {
    const TriangleId t(cut.ids[i]);
    if (mt.remover(t).isValid() && !isSatisfied(mt, criterion, t, mt.corners(t))) ++unmet;
  }
  EXPECT_EQ(unmet, 0u) << "of " << cut.ids.size() << " triangles";
}

/// Conforming, met, the minimal one never larger than the saturated one, which refuses what has no bound.
inline void expectCutsKept(const MultiTriangulation& mt, const Criterion& criterion) {
  const DomainExtent domain = domainExtent(mt);
  const auto minimal = takeCut(mt, criterion);
  ASSERT_TRUE(minimal) << minimal.error().describe();
  EXPECT_TRUE(validateFront(mt, *minimal, domain));
  expectMet(mt, criterion, *minimal);
  const auto saturated = takeCut(mt, criterion, {.method = CutMethod::saturated});
  ASSERT_EQ(saturated.has_value(), criterion.bounded() != nullptr);
  if (!saturated) {
    EXPECT_EQ(saturated.error().code, ErrorCode::usage);
    return;
  }
  EXPECT_TRUE(validateFront(mt, *saturated, domain));
  expectMet(mt, criterion, *saturated);
  EXPECT_LE(minimal->triangles.size(), saturated->triangles.size());
}

/// A clock that strikes after so many looks at it.
inline Deadline strikeAfter(int looks) {
  auto left = std::make_shared<int>(looks);
  return Deadline([left] { return double((*left)--); });
}

}  // namespace arete
