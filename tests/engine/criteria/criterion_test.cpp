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

namespace arete {
namespace {

/// visit(sample's position, the front's height there): for every sample of the domain, once per triangle over
/// it.
void forSamples(const TerrainModel& model, const Cut& cut, const std::function<void(Vec3, double)>& visit) {
  const RasterHeightfield field = model.rasterSamples();
  for (const auto& triangle : cut.triangles) {
    std::array<Vec3, 3> p;
    for (int i = 0; i < 3; ++i) p[i] = model.mt.position(VertexId(cut.vertices[triangle[i]]));
    const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
    const int x0 = int(std::min({p[0].x, p[1].x, p[2].x})), x1 = int(std::max({p[0].x, p[1].x, p[2].x}));
    const int y0 = int(std::min({p[0].y, p[1].y, p[2].y})), y1 = int(std::max({p[0].y, p[1].y, p[2].y}));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        std::array<double, 3> w;
        for (int i = 0; i < 3; ++i) {
          const Vec3 &a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
          w[i] = ((a.x - x) * (b.y - y) - (b.x - x) * (a.y - y)) / area;
        }
        if (w[0] < 0 || w[1] < 0 || w[2] < 0) continue;
        const double z = field.heights[field.index(std::uint32_t(x), std::uint32_t(y))];
        if (!std::isnan(z)) visit({double(x), double(y), z}, w[0] * p[0].z + w[1] * p[1].z + w[2] * p[2].z);
      }
  }
}

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
void expectSameOfManyAsOfEach(const Criterion& criterion, const Extent& e, std::mt19937_64& random) {
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
            if (mt.error(t) > criterion->mostAllowed(arrays.sphere[n])) {
              EXPECT_FALSE(criterion->isFineEnough(mt, t, corners)) << m.name << " " << name << " node " << n;
              ++failing[name];
            }
            // Who could go is satisfied by the bound, though what may stand below it reach beyond the ball.
            if (!mt.remover(t).isValid() || !criterion->isMonotone() ||
                mt.error(t) > criterion->allowedError(arrays.sphere[n]))
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
          if (!criterion->isMonotone()) continue;
          SCOPED_TRACE(m.name + " " + name);
          for (int i = 0; i < 4; ++i) expectSameOfManyAsOfEach(*criterion, e, random);
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

TEST(ViewError, KeepsItsPixelsOnTheScreenOfEveryCamera) {
  std::mt19937_64 random(31);
  std::size_t seen = 0;
  for (const FamilyModel& m : familyModels())
    for (int round = 0; round < 25; ++round) {
      const MetricFrame& metric = m.model.mt.arrays().metric;
      const View view = randomView(Extent(m.model.mt), random);
      ASSERT_TRUE(view.validate());
      const double pixels = round % 2 ? 1 : 8;
      // A camera of the test's own: screen coordinates in pixels, or nothing out of sight.
      const double length = std::hypot(view.forward.x, view.forward.y, view.forward.z);
      const Vec3 f{view.forward.x / length, view.forward.y / length, view.forward.z / length};
      const double flat = std::hypot(f.x, f.y);
      const Vec3 r{f.y / flat, -f.x / flat, 0}, u{-f.x * f.z / flat, -f.y * f.z / flat, flat};
      const double focal = view.heightPixels / 2 / std::tan(view.verticalFieldOfView / 2);
      const auto project = [&](Vec3 p) -> std::optional<Vec2> {
        const Vec3 d{p.x - view.eye.x, p.y - view.eye.y, p.z - view.eye.z};
        const double depth = d.x * f.x + d.y * f.y + d.z * f.z;
        if (depth <= 0) return std::nullopt;
        const Vec2 s{focal * (d.x * r.x + d.y * r.y) / depth,
                     focal * (d.x * u.x + d.y * u.y + d.z * u.z) / depth};
        if (std::abs(s.x) > view.widthPixels / 2 || std::abs(s.y) > view.heightPixels / 2)
          return std::nullopt;
        return s;
      };
      const ViewError criterion({.view = view, .pixels = pixels}, metric);
      for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
        const auto cut = takeCut(m.model.mt, criterion, {.method = method});
        ASSERT_TRUE(cut);
        forSamples(m.model, *cut, [&](Vec3 p, double z) {
          const auto drawn = project(metric.toMetric({p.x, p.y, z})), real = project(metric.toMetric(p));
          if (!drawn || !real) return;
          ++seen;
          EXPECT_LE(std::hypot(drawn->x - real->x, drawn->y - real->y), pixels * (1 + 1e-6) + 1e-6)
              << m.name << " round " << round;
        });
      }
    }
  EXPECT_GT(seen, 10000u);
}

TEST(ViewError, LeavesWhatIsOutOfSightCoarse) {
  const FamilyModel& m = familyModels().front();
  const Extent e(m.model.mt);
  View view;
  view.eye = {e.high.x + e.size(), 0, e.high.z + e.relief()};
  view.forward = {1, 0, 0};  // away from the terrain
  const auto cut = takeCut(m.model.mt, ViewError({.view = view}, m.model.mt.arrays().metric));
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->nodes, 0u);
}

TEST(View, NamesTheNumberThatMakesNoSense) {
  View view;
  EXPECT_TRUE(view.validate());
  view.up = {0, 2, 0};
  EXPECT_NE(view.validate().error().message.find("two different directions"), std::string::npos);
  view = {};
  view.verticalFieldOfView = M_PI;
  EXPECT_NE(view.validate().error().message.find("180 degrees"), std::string::npos);
  view = {};
  view.heightPixels = 0;
  EXPECT_NE(view.validate().error().message.find("pixel"), std::string::npos);
  view = {};
  view.nearDistance = 2, view.farDistance = 1;
  EXPECT_NE(view.validate().error().message.find("near"), std::string::npos);
  view = {};
  view.eye.x = NAN;
  EXPECT_NE(view.validate().error().message.find("finite"), std::string::npos);
}

}  // namespace
}  // namespace arete
