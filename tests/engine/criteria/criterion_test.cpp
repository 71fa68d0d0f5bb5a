// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a criterion promises, checked where it counts: at the samples. Each sample of a generated raster is
// looked up in the front by plain search, and its error there held against what the criterion allows at that
// very place, by formulas of the test's own.
#include "engine/criteria/criterion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <string>

#include "engine/cut_promises.h"
#include "engine/family_models.h"
#include "engine/front_samples.h"

namespace arete {
namespace {

double spanOf(const TerrainModel& model) {
  return model.mt.nodeCount() ? model.mt.largestError() : 1;
}

/// Both cuts, and no sample with more error than `allowed` says of its place (metric), but for rounding.
void expectAllowed(const FamilyModel& m, const Criterion& criterion,
                   const std::function<double(Vec3 metric)>& allowed) {
  const MetricFrame& metric = m.model.mt.arrays().metric;
  for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
    const auto cut = takeCut(m.model.mt, criterion, {.method = method});
    ASSERT_TRUE(cut);
    std::size_t broken = 0;
    forSamples(m.model, *cut, [&](Vec3 p, double z) {
      const double slack = 1e-9 * (1 + std::abs(p.z));
      if (std::abs(z - p.z) > allowed(metric.toMetric(p)) * (1 + 1e-9) + slack) ++broken;
    });
    EXPECT_EQ(broken, 0u) << m.name;
  }
}

/// Balls of every size near and far, and errors at and around what is allowed there.
void expectSameOfManyAsOfEach(const BoundedCriterion& criterion, const Extent& e, std::mt19937_64& random) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  std::uniform_real_distribution<double> unit(0, 1);
  const auto anySize = [&](double least, double most) {
    return least * std::pow(most / least, unit(random));
  };
  std::vector<Sphere> balls(1 + random() % 64);
  std::vector<float> errors;
  for (Sphere& s : balls) {
    const double far = anySize(1e-6, 1e4) * e.size();
    const auto place = [&](double low, double high) {
      return static_cast<float>(low + (high - low) * unit(random) + far * (2 * unit(random) - 1));
    };
    s = {place(e.low.x, e.high.x), place(e.low.y, e.high.y), place(e.low.z, e.high.z),
         static_cast<float>(anySize(1e-7, 10) * e.size())};
    const double allowed = criterion.allowedError(s);
    const auto exact = static_cast<float>(allowed);
    const float choices[] = {exact,
                             std::nextafter(exact, 0.0f),
                             std::nextafter(exact, kInfinity),
                             static_cast<float>(allowed * (1 + 1e-3 * (unit(random) - 0.5))),
                             static_cast<float>(allowed * anySize(1e-3, 1e3)),
                             static_cast<float>(anySize(1e-6, 10) * e.relief()),
                             0.0f};
    errors.push_back(std::min(choices[random() % 7], 1e30f));
  }
  const std::uint64_t bits = criterion.exceeding(balls, errors);
  for (std::size_t i = 0; i < 64; ++i)
    EXPECT_EQ((bits >> i & 1) != 0, i < balls.size() && errors[i] > criterion.allowedError(balls[i]))
        << "ball " << i << " of " << balls.size() << ": " << balls[i % balls.size()].x << " "
        << balls[i % balls.size()].y << " " << balls[i % balls.size()].z << " "
        << balls[i % balls.size()].radius;
}

/// What a criterion says of a node's ball, held against its triangles, of any errors.
TEST(Criteria, AllowTrianglesInABallWhatTheySayAtLeastAndAtMost) {
  std::mt19937_64 random(4);
  std::map<std::string, std::size_t> failing, passing;
  for (const FamilyModel& m : familyModels())
    for (int round = 0; round < 4; ++round) {
      MtArrays arrays = m.model.mt.arrays();
      std::vector<OutwardScale::Code> error(arrays.error.size());
      const OutwardScale::Code largest = arrays.scale.floorCode(2 * spanOf(m.model));
      for (OutwardScale::Code& code : error)
        code = static_cast<OutwardScale::Code>(random() % (largest + 1u));
      arrays.error = error;
      const MultiTriangulation mt(arrays, nullptr);
      for (const auto& [name, criterion] : criteriaFor(m.model.mt, random))
        for (std::uint32_t n = 0; n < mt.nodeCount(); ++n)
          for (std::uint32_t slot = 0; slot < mt.slotCount(NodeId(n)); ++slot) {
            const TriangleId t = mt.slotTriangle(NodeId(n), slot);
            if (mt.remover(t) == NodeId(n)) continue;  // no triangle
            const auto corners = mt.corners(t, NodeId(n));
            const BoundedCriterion* const bounded = criterion->bounded();
            if (bounded != nullptr && mt.error(t) > bounded->mostAllowed(arrays.sphere[n])) {
              EXPECT_FALSE(criterion->isFineEnough(mt, t, corners)) << m.name << " " << name << " node " << n;
              ++failing[name];
            }
            // isSatisfied() accepts what the bound accepts, though the terrain below may lie outside the
            // ball.
            if (!mt.remover(t).isValid() || bounded == nullptr ||
                mt.error(t) > bounded->allowedError(arrays.sphere[n]))
              continue;
            EXPECT_TRUE(isSatisfied(mt, *criterion, t, corners)) << m.name << " " << name << " node " << n;
            ++passing[name];
          }
    }
  for (const char* name : {"uniform", "region", "corridor", "distance", "any of uniform and distance"}) {
    EXPECT_GT(failing[name], 1000u) << name;
    EXPECT_GT(passing[name], 1000u) << name;
  }
}

TEST(Criteria, SayOfManyBallsAtOnceWhatTheySayOfEach) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    for (const FamilyModel& m : familyModels()) {
      const Extent e(m.model.mt);
      for (int round = 0; round < 8; ++round) {
        std::vector<NamedCriterion> criteria = criteriaFor(m.model.mt, random);
        ViewError::Options o{
            .view = randomView(e, random), .pixels = 0.5, .outsideError = 0.2 * spanOf(m.model)};
        o.view.nearDistance = 0.01 * e.size();
        o.view.farDistance = 0.5 * e.size();
        criteria.push_back(
            {"view, near and far", std::make_shared<ViewError>(o, m.model.mt.arrays().metric)});
        o.view.verticalFieldOfView = 3.1;
        criteria.push_back(
            {"view, nearly half of all", std::make_shared<ViewError>(o, m.model.mt.arrays().metric)});
        for (const auto& [name, criterion] : criteria) {
          if (criterion->bounded() == nullptr) continue;
          SCOPED_TRACE(m.name + " " + name);
          for (int i = 0; i < 4; ++i) expectSameOfManyAsOfEach(*criterion->bounded(), e, random);
        }
      }
    }
  }
}

TEST(Corridor, IsFineWithinItsDistanceOfTheLine) {
  for (const FamilyModel& m : familyModels()) {
    const MetricFrame& metric = m.model.mt.arrays().metric;
    const double inside = 0.01 * spanOf(m.model), distance = 0.1 * Extent(m.model.mt).size();
    const std::vector<Vec2> line = {{2, 3}, {14, 9}, {25, 20}};
    const RegionError criterion(Region({.lines = {line}, .distance = distance}, metric), metric, inside,
                                1e30);
    expectAllowed(m, criterion, [&](Vec3 p) {
      for (int k = 0; k + 1 < 3; ++k)
        for (double t = 0; t <= 1; t += 1.0 / 512) {  // by walking along it
          const Vec3 q = metric.toMetric(
              {line[k].x + t * (line[k + 1].x - line[k].x), line[k].y + t * (line[k + 1].y - line[k].y), 0});
          if (std::hypot(q.x - p.x, q.y - p.y) <= distance) return inside;
        }
      return 1e30;
    });
  }
}

TEST(DistanceError, GrowsWithTheDistanceAndNoFaster) {
  for (const FamilyModel& m : familyModels()) {
    const Extent e(m.model.mt);
    const double span = spanOf(m.model);
    for (const bool inPlan : {true, false}) {
      const DistanceError::Options o{.place = {0.1 * e.size(), -0.2 * e.size(), 0},
                                     .inPlan = inPlan,
                                     .nearError = 0.002 * span,
                                     .growth = 0.7 * span / e.size(),
                                     .farError = 0.4 * span};
      const MetricFrame& metric = m.model.mt.arrays().metric;
      for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
        const auto cut = takeCut(m.model.mt, DistanceError(o), {.method = method});
        ASSERT_TRUE(cut);
        forSamples(m.model, *cut, [&](Vec3 p, double z) {
          // The nearest point of the triangle is no farther than the one over the sample.
          const Vec3 q = metric.toMetric({p.x, p.y, z});
          const double d = inPlan ? std::hypot(q.x - o.place.x, q.y - o.place.y)
                                  : std::hypot(q.x - o.place.x, q.y - o.place.y, q.z - o.place.z);
          EXPECT_LE(std::abs(z - p.z), std::min(o.nearError + o.growth * d, o.farError) * (1 + 1e-9) + 1e-9)
              << m.name;
        });
      }
    }
  }
}

}  // namespace
}  // namespace arete
