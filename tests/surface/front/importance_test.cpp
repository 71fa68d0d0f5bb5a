// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is promised by importance, held against points of the source: each is within E / w of the cut, where w
// is linear over its face. The oracle searches every triangle of the cut.
#include "surface/front/importance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "engine/base/nearest_on_triangle.h"
#include "engine/criteria/space_region.h"
#include "engine/cut/cut.h"
#include "surface/builder/build.h"
#include "surface/front/attribute_criterion.h"
#include "surface/front/front.h"
#include "surface/shapes.h"

namespace arete {
namespace {

/// A ring with a rough side, and a number of its vertices.
template <class Weight>
SurfaceMesh roughRing(const Weight& weight, std::uint64_t seed = 1, std::uint32_t size = 40) {
  SurfaceMesh mesh(shapes::sheet(size, size, true, true));
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> rough(-0.02, 0.02);
  for (Vec3& p : mesh.positions) p = p + Vec3{rough(random), rough(random), rough(random)};
  Attribute heat{.name = "heat", .type = ScalarType::float64};
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    heat.append(std::array{double(weight(mesh.positions[v], random))});
  mesh.vertexAttributes = {heat};
  return mesh;
}

double distanceFrom(const TriangleMesh& mesh, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles)
    least = std::min(
        least, distanceToTriangle(p, {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}));
  return least;
}

/// The largest distance of a point of the source from a cut, times its importance.
double weightedDistance(const SurfaceMesh& source, const TriangleMesh& cut, std::mt19937_64& random,
                        int samples) {
  const Attribute& heat = source.vertexAttributes.front();
  double most = 0;
  for (int i = 0; i < samples; ++i) {
    const auto& t = source.triangles[random() % source.triangles.size()];
    std::array<double, 3> share{};
    if (i % 3 == 0) {
      share[random() % 3] = 1;  // a corner
    } else {
      for (double& s : share) s = -std::log(1 - double(random() >> 11) / double(1ull << 53));
      const double sum = share[0] + share[1] + share[2];
      for (double& s : share) s /= sum;
    }
    Vec3 place{};
    double weight = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      place = place + share[k] * source.positions[t[k]];
      weight += share[k] * heat.numbers(t[k]).front();
    }
    most = std::max(most, weight * distanceFrom(cut, place));
  }
  return most;
}

Cut cutBy(const SurfaceModel& model, const BoundedCriterion& criterion, const Importance& importance,
          CutOptions options = {}) {
  auto cut = takeCut(model.mt, ImportanceCriterion(criterion, importance), options);
  EXPECT_TRUE(cut) << cut.error().describe();
  return *cut;
}

TEST(Importance, DividesTheToleranceAtEveryPointOfTheSource) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    // Single hot vertices, which coarse triangles seldom have as corners; a tenth is below 1.
    const SurfaceMesh mesh = roughRing(
        [](const Vec3&, std::mt19937_64& random) {
          return random() % 50 == 0 ? 20.0 : random() % 10 == 0 ? 0.5 : 1.0;
        },
        seed, 24);
    const auto model = buildSurface(mesh);
    ASSERT_TRUE(model) << model.error().describe();
    const auto importance = importanceOf(*model, model->attributes.vertexAttributes.front(), false);
    ASSERT_TRUE(importance) << importance.error().describe();
    EXPECT_EQ(importance->largest, 20);
    EXPECT_EQ(importance->least, 0.5);
    std::mt19937_64 random(seed);
    for (const double error : {0.05, 0.2, 0.8}) {
      const Cut cut = cutBy(*model, UniformError(error), *importance);
      const SurfaceFront front = surfaceOf(*model, cut);
      EXPECT_LE(weightedDistance(mesh, front.mesh, random, 200), error * (1 + 1e-9)) << error;
    }
  }
}

TEST(Importance, OfATriangleIsAtLeastAsLargeAsOfAnyFaceThatItStandsFor) {
  const SurfaceMesh mesh =
      roughRing([](const Vec3&, std::mt19937_64& random) { return random() % 400 == 0 ? 9.0 : 1.0; });
  const auto model = buildSurface(mesh);
  ASSERT_TRUE(model);
  const auto importance = importanceOf(*model, model->attributes.vertexAttributes.front(), false);
  ASSERT_TRUE(importance);
  // Every hot vertex is within the error of a hot triangle, in every prefix of the nodes.
  const Attribute& heat = mesh.vertexAttributes.front();
  std::uint64_t hotTriangles = 0, allTriangles = 0;
  for (const double part : {0.02, 0.1, 0.4}) {
    const Cut cut = frontOfPrefix(model->mt, std::uint32_t(part * model->mt.nodeCount()));
    const SurfaceFront front = surfaceOf(*model, cut);
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
      if (heat.numbers(v).front() < 9) continue;
      bool isFound = false;
      for (std::size_t i = 0; i < cut.ids.size() && !isFound; ++i) {
        const auto& t = front.mesh.triangles[i];
        isFound = importance->of(TriangleId(cut.ids[i])) >= 9 &&
                  distanceToTriangle(mesh.positions[v],
                                     {front.mesh.positions[t[0]], front.mesh.positions[t[1]],
                                      front.mesh.positions[t[2]]}) <= front.errors[i] * (1 + 1e-6) + 1e-9;
      }
      EXPECT_TRUE(isFound) << "vertex " << v << " at " << part;
    }
    allTriangles += cut.ids.size();
    for (const std::uint32_t id : cut.ids) hotTriangles += importance->of(TriangleId(id)) > 1 ? 1 : 0;
  }
  // And most of the surface is not hot.
  EXPECT_LT(hotTriangles, allTriangles / 2);
}

TEST(Importance, ThatIsTheSameEverywhereIsAnotherTolerance) {
  const auto model = buildSurface(roughRing([](const Vec3&, std::mt19937_64&) { return 4.0; }));
  ASSERT_TRUE(model);
  const auto importance = importanceOf(*model, model->attributes.vertexAttributes.front(), false);
  ASSERT_TRUE(importance);
  for (const double error : {0.1, 0.4, 2.0})
    EXPECT_EQ(cutBy(*model, UniformError(error), *importance).ids,
              takeCut(model->mt, UniformError(error / 4), {})->ids)
        << error;
}

TEST(Importance, IsPaidForWhereItIs) {
  // One side of the ring is ten times as important.
  const SurfaceMesh mesh = roughRing([](const Vec3& p, std::mt19937_64&) { return p.x > 2 ? 10.0 : 1.0; });
  const auto model = buildSurface(mesh);
  ASSERT_TRUE(model);
  const auto importance = importanceOf(*model, model->attributes.vertexAttributes.front(), false);
  ASSERT_TRUE(importance);
  const double error = 0.3;
  const Cut cut = cutBy(*model, UniformError(error), *importance);
  // A region of the same extent takes nearly as many.
  const auto side = std::make_shared<BoxRegion>(Vec3{2, -9, -9}, Vec3{9, 9, 9});
  const auto ofRegion = takeCut(model->mt, SpaceRegionError(side, model->mt.metric(), error / 10, error), {});
  ASSERT_TRUE(ofRegion);
  std::printf("%zu triangles, %zu by a region\n", cut.ids.size(), ofRegion->ids.size());
  EXPECT_LE(double(cut.ids.size()), 1.15 * double(ofRegion->ids.size()));
  // A budget is spent there, too.
  const auto squares = std::make_shared<LargestSquaresFirst>();
  const auto shareOnSide = [&](const std::shared_ptr<const RefineOrder>& order) {
    const SurfaceFront front =
        surfaceOf(*model, cutBy(*model, UniformError(0), *importance, {.maxTriangles = 400, .order = order}));
    return double(std::ranges::count_if(front.mesh.positions, [](const Vec3& p) { return p.x > 2; })) /
           double(front.mesh.positions.size());
  };
  EXPECT_GT(shareOnSide(std::make_shared<ImportantFirst>(squares, *importance)), 1.2 * shareOnSide(squares));
}

TEST(Importance, CountsWithinARegionAloneAndBesideAttributes) {
  const SurfaceMesh mesh =
      roughRing([](const Vec3&, std::mt19937_64& random) { return 1 + 3 * double(random() % 2); }, 7, 28);
  const auto model = buildSurface(mesh, {.boundsAttributes = true});
  ASSERT_TRUE(model);
  const auto importance = importanceOf(*model, model->attributes.vertexAttributes.front(), false);
  ASSERT_TRUE(importance);
  const double error = 0.2;
  const auto ball = std::make_shared<BallRegion>(Vec3{3, 0, 0}, 1.5);
  const SpaceRegionError inBall(ball, model->mt.metric(), error, std::numeric_limits<double>::infinity());
  const ImportanceCriterion important(inBall, *importance);
  const AttributeCriterion both(important, *model, {{0, 0.5}});
  const auto cut = takeCut(model->mt, both, {});
  ASSERT_TRUE(cut);
  EXPECT_LT(cut->ids.size(), model->mt.finestTriangleCount() * 3 / 4);
  const SurfaceFront front = surfaceOf(*model, *cut);
  const Attribute& heat = mesh.vertexAttributes.front();
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (norm(mesh.positions[v] - Vec3{3, 0, 0}) > 1.5) continue;
    EXPECT_LE(heat.numbers(v).front() * distanceFrom(front.mesh, mesh.positions[v]), error * (1 + 1e-9));
  }
}

TEST(Importance, ThatIsNotAboveZeroIsRefusedByItsVertex) {
  for (const double bad :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    SurfaceMesh mesh = roughRing([](const Vec3&, std::mt19937_64&) { return 1.0; }, 1, 8);
    Attribute heat = emptyLike(mesh.vertexAttributes.front());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) heat.append(std::array{v == 37 ? bad : 1.0});
    mesh.vertexAttributes = {heat};
    const auto model = buildSurface(mesh);
    ASSERT_TRUE(model) << model.error().describe();
    const auto refused = importanceOf(*model, model->attributes.vertexAttributes.front(), false);
    ASSERT_FALSE(refused) << bad;
    EXPECT_EQ(refused.error().code, ErrorCode::invalidData);
    EXPECT_NE(refused.error().message.find("vertex 37 "), std::string::npos) << refused.error().message;
  }
}

}  // namespace
}  // namespace arete
