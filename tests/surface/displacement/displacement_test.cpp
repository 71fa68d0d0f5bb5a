// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/base/nearest_on_triangle.h"
#include "engine/criteria/refine_order.h"
#include "engine/criteria/space_region.h"
#include "full_run.h"
#include "surface/builder/build.h"
#include "surface/displacement/displaced_places.h"
#include "surface/displacement/find_displacement.h"
#include "surface/families.h"
#include "surface/front/front.h"
#include "surface/laws/validate_surface.h"
#include "surface/parted.h"

namespace arete {
namespace {

SurfaceModel built(const TriangleMesh& mesh, const SurfaceBuildOptions& options = {}) {
  Result<SurfaceModel> model = buildSurface(SurfaceMesh(mesh), options);
  EXPECT_TRUE(model) << (model ? "" : model.error().message);
  return std::move(*model);
}

SurfaceModel displaced(const TriangleMesh& mesh, const SurfaceBuildOptions& options = {}) {
  SurfaceModel model = built(mesh, options);
  Result<SurfaceDisplacement> displacement = findDisplacement(model);
  EXPECT_TRUE(displacement) << (displacement ? "" : displacement.error().message);
  model.displacement = std::move(*displacement);
  return model;
}

/// The largest distance of a sample from the nearest triangle, by trying all.
double farthest(const std::vector<Vec3>& samples, const Cut& cut, const std::vector<Vec3>& places) {
  double most = 0;
  for (const Vec3& p : samples) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : cut.triangles)
      least = std::min(least, distanceToTriangle(p, {places[a], places[b], places[c]}));
    most = std::max(most, least);
  }
  return most;
}

std::vector<Vec3> samplesOf(const TriangleMesh& mesh) {
  std::vector<Vec3> samples;
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const std::uint32_t v : {a, b, c}) samples.push_back(mesh.positions[v]);
    samples.push_back((mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0);
  }
  return samples;
}

double rootMeanSquare(const std::vector<Vec3>& samples, const Cut& cut, const std::vector<Vec3>& places) {
  double sum = 0;
  for (const Vec3& p : samples) {
    const double d = farthest({p}, cut, places);
    sum += d * d;
  }
  return std::sqrt(sum / double(samples.size()));
}

TEST(Displacement, KeepsTheErrorOfTheCutOnEveryFamily) {
  for (const shapes::NamedMesh& of : shapes::families(7)) {
    SCOPED_TRACE(of.name);
    const SurfaceModel model = displaced(of.mesh);
    const std::vector<Vec3> samples = samplesOf(of.mesh);
    for (std::uint32_t part = 0; part < 5; ++part) {
      const Cut cut = frontOfPrefix(model.mt, model.mt.nodeCount() * part / 5);
      const auto places =
          displacedPlaces(model.mt, model.displacement, cut, promisedErrors(model.mt, cut, nullptr));
      EXPECT_LE(farthest(samples, cut, places), cut.achievedError * (1 + 1e-9));
    }
    const Status valid = validateSurface(model);
    EXPECT_TRUE(valid) << valid.error().message;
  }
}

TEST(Displacement, KeepsTheErrorInRandomClosedNodeSets) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const TriangleMesh mesh = shapes::shaken(shapes::globe(20, 12), seed, 0.05);
    const SurfaceModel model = displaced(mesh);
    std::mt19937_64 random(seed);
    NodeSet set(model.mt.nodeCount(), 0);
    for (int i = 0; i < 30; ++i) set[random() % set.size()] = 1;
    closeUpwards(model.mt, set);
    const Cut cut = front(model.mt, set);
    const auto places =
        displacedPlaces(model.mt, model.displacement, cut, promisedErrors(model.mt, cut, nullptr));
    EXPECT_LE(farthest(samplesOf(mesh), cut, places), cut.achievedError * (1 + 1e-9));
  }
}

TEST(Displacement, ComesNearerToACurvedSurface) {
  const TriangleMesh mesh = shapes::globe(40, 24);
  const SurfaceModel model = displaced(mesh);
  CutOptions options;
  options.maxTriangles = 120;
  options.order = std::make_shared<LargestSquaresFirst>();
  const Result<Cut> cut = takeCut(model.mt, UniformError(0), options);
  ASSERT_TRUE(cut);
  std::vector<Vec3> places;
  for (const std::uint32_t v : cut->vertices) places.push_back(model.mt.position(VertexId(v)));
  const std::vector<Vec3> samples = samplesOf(mesh);
  const double before = rootMeanSquare(samples, *cut, places);
  const auto after =
      displacedPlaces(model.mt, model.displacement, *cut, promisedErrors(model.mt, *cut, nullptr));
  EXPECT_LT(rootMeanSquare(samples, *cut, after), 0.7 * before);
}

TEST(Displacement, LeavesTheFinestFrontWhereItIs) {
  const SurfaceModel model = displaced(shapes::hills(20, 2));
  const Cut cut = frontOfPrefix(model.mt, model.mt.nodeCount());
  const auto places =
      displacedPlaces(model.mt, model.displacement, cut, promisedErrors(model.mt, cut, nullptr));
  for (std::size_t v = 0; v < places.size(); ++v)
    EXPECT_EQ(places[v], model.mt.position(VertexId(cut.vertices[v])));
}

TEST(Displacement, StaysInThePlaneOfAFlatSheet) {
  const SurfaceModel model = displaced(shapes::sheet(12, 9));
  for (std::uint32_t v = 0; v < model.mt.vertexCount(); ++v) EXPECT_EQ(model.displacement.direction(v).z, 0);
}

TEST(Displacement, IsTheSameForAnyNumberOfThreads) {
  const SurfaceModel model = built(shapes::families(3)[6].mesh);
  RunContext one, two, four;
  one.threads = 1;
  two.threads = 2;
  four.threads = 4;
  const auto first = findDisplacement(model, one);
  ASSERT_TRUE(first);
  EXPECT_EQ(*first, *findDisplacement(model, two));
  EXPECT_EQ(*first, *findDisplacement(model, four));
}

TEST(Displacement, DoesNotDependOnTheUnit) {
  TriangleMesh mesh = shapes::shaken(shapes::globe(20, 12), 5, 0.02);
  const SurfaceModel small = displaced(mesh);
  for (Vec3& p : mesh.positions) p = p * 1024.0;
  EXPECT_EQ(displaced(mesh).displacement, small.displacement);
}

TEST(Displacement, LeavesBordersThatAreKeptWhereTheyAre) {
  const TriangleMesh mesh = shapes::hills(20, 4);
  const SurfaceModel model = displaced(mesh, {.keepsBorders = true});
  double side = 0;
  for (const Vec3& p : mesh.positions) side = std::max(side, p.x);
  int moved = 0;
  for (std::uint32_t v = 0; v < model.mt.vertexCount(); ++v) {
    const Vec3 p = model.mt.position(VertexId(v));
    const bool isBorder = p.x == 0 || p.y == 0 || p.x == side || p.y == side;
    if (isBorder) {
      EXPECT_EQ(model.displacement.direction(v), (Vec3{0, 0, 0}));
    }
    moved += model.displacement.direction(v) == Vec3{0, 0, 0} ? 0 : 1;
  }
  EXPECT_GT(moved, 100);
}

TEST(Displacement, EndsWhenItIsInterrupted) {
  const SurfaceModel model = built(shapes::hills(20, 2));
  const std::atomic<bool> stop = true;
  RunContext context;
  context.cancel = &stop;
  const auto displacement = findDisplacement(model, context);
  ASSERT_FALSE(displacement);
  EXPECT_EQ(displacement.error().code, ErrorCode::interrupted);
}

TEST(PromisedErrors, AreThoseOfTheRegionInsideAndTheLargestOutside) {
  const SurfaceModel model = built(shapes::hills(30, 2));
  const auto region = std::make_shared<BoxRegion>(Vec3{0, 0, -9}, Vec3{8, 8, 99});
  const SpaceRegionError criterion(region, model.mt.arrays().metric, 0.02, 10);
  const Result<Cut> cut = takeCut(model.mt, criterion);
  ASSERT_TRUE(cut);
  ASSERT_GT(cut->achievedError, 0.2);
  const std::vector<double> promised = promisedErrors(model.mt, *cut, &criterion);
  int inside = 0, outside = 0;
  for (std::size_t t = 0; t < promised.size(); ++t) {
    double least = 1e9;
    for (const std::uint32_t v : cut->triangles[t]) {
      const Vec3 p = model.mt.position(VertexId(cut->vertices[v]));
      least = std::min(least, std::max(p.x, p.y));
    }
    EXPECT_GE(promised[t], model.mt.error(TriangleId(cut->ids[t])));
    if (least <= 8) {
      EXPECT_LE(promised[t], std::max(0.02, model.mt.error(TriangleId(cut->ids[t]))));
      ++inside;
    } else if (least > 20) {
      EXPECT_EQ(promised[t], cut->achievedError);
      ++outside;
    }
  }
  EXPECT_GT(inside, 20);
  EXPECT_GT(outside, 2);
}

TEST(PromisedErrors, AreTheLargestOneWhereABudgetEndsTheRefinement) {
  const SurfaceModel model = built(shapes::hills(30, 2));
  CutOptions options;
  options.maxTriangles = 100;
  const Result<Cut> cut = takeCut(model.mt, UniformError(0), options);
  ASSERT_TRUE(cut);
  const UniformError criterion(0);
  for (const double error : promisedErrors(model.mt, *cut, &criterion)) EXPECT_EQ(error, cut->achievedError);
}

TEST(Displacement, KeepsPartsAndChartsWithinTheErrorOfEveryCut) {
  for (std::uint64_t seed = 1; seed <= (test::isFull() ? 300u : 40u); ++seed) {
    const parted::RandomSurface surface = parted::randomSurface(seed);
    SCOPED_TRACE(surface.name);
    Result<SurfaceModel> model = buildSurface(surface.mesh);
    ASSERT_TRUE(model);
    Result<SurfaceDisplacement> found = findDisplacement(*model);
    ASSERT_TRUE(found);
    model->displacement = std::move(*found);
    std::mt19937_64 random(seed);
    const std::vector<parted::Sample> samples = parted::samplesOf(surface.mesh, random);
    for (const double share : {0.005, 0.02, 0.1}) {
      const double allowed = share * model->diagonal;
      const UniformError criterion(allowed);
      const Result<Cut> cut = takeCut(model->mt, criterion);
      ASSERT_TRUE(cut);
      SurfaceFront front = surfaceOf(*model, *cut);
      const std::vector<double> promised = promisedErrors(model->mt, *cut, nullptr);
      front.mesh.positions = displacedPlaces(model->mt, model->displacement, *cut, promised);
      const auto violation = parted::violation(samples, front.mesh, cut->achievedError);
      EXPECT_FALSE(violation) << *violation;
    }
    const Status valid = validateSurface(*model, {.everySample = true});
    EXPECT_TRUE(valid) << valid.error().message;
  }
}

}  // namespace
}  // namespace arete
