// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/fit/fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/cut/cut.h"
#include "full_run.h"
#include "surface/builder/build.h"
#include "surface/families.h"
#include "surface/fit/held_vertices.h"
#include "surface/front/front.h"

namespace arete {
namespace {

struct Fitted {
  TriangleMesh source, cut;
  std::vector<std::uint8_t> isHeld;
};

/// A cut of a mesh with about a share of its triangles.
Fitted cutOf(const TriangleMesh& source, double share, bool keepsBorders = false) {
  const Result<SurfaceModel> model = buildSurface(SurfaceMesh(source));
  if (!model) throw std::runtime_error(model.error().message);
  const auto most = static_cast<std::uint32_t>(share * double(source.triangles.size()));
  const Result<Cut> cut = takeCut(model->mt, UniformError(0), {.maxTriangles = most});
  if (!cut) throw std::runtime_error(cut.error().message);
  const SurfaceFront front = surfaceOf(*model, *cut);
  return {source, front.mesh.shape(), heldVertices(front.mesh, keepsBorders)};
}

FittedSurface fitted(const Fitted& f, const RunContext& context = {}) {
  const auto result = fitSurface(f.cut, f.isHeld, f.source, {.samples = 20'000}, context);
  if (!result) throw std::runtime_error(result.error().message);
  return *result;
}

TEST(FitSurface, LeavesLessThanThreeQuartersOfTheDistanceWhereASurfaceIsRound) {
  for (const TriangleMesh& mesh : {shapes::globe(60, 30), shapes::sheet(60, 40, true, true)}) {
    const Fitted f = cutOf(mesh, 0.1);
    const FittedSurface result = fitted(f);
    EXPECT_LT(result.rmsAfter, 0.75 * result.rmsBefore);
    EXPECT_GT(result.steps, 0);
  }
}

// An oracle that shares nothing with the fit: vertices of a round ball lie outside of it after the fit,
// because chords lie inside of it.
TEST(FitSurface, PutsTheVerticesOfABallOutsideOfIt) {
  const FittedSurface result = fitted(cutOf(shapes::globe(80, 40), 0.04));
  double sum = 0;
  for (const Vec3& p : result.positions) {
    EXPECT_GT(norm(p), 0.995);
    EXPECT_LT(norm(p), 1.08);
    sum += norm(p);
  }
  EXPECT_GT(sum / double(result.positions.size()), 1.005);
}

TEST(FitSurface, MovesNothingWhereTheCutIsTheSource) {
  for (const shapes::NamedMesh& family : shapes::families(4)) {
    SCOPED_TRACE(family.name);
    const Fitted f{family.mesh, family.mesh, std::vector<std::uint8_t>(family.mesh.positions.size(), 0)};
    const FittedSurface result = fitted(f);
    EXPECT_LT(result.rmsBefore, 1e-9);
    for (std::size_t v = 0; v < f.cut.positions.size(); ++v)
      EXPECT_LT(norm(result.positions[v] - f.cut.positions[v]), 1e-6);
  }
}

TEST(FitSurface, NeverLeavesMoreAndNeverFolds) {
  for (std::uint64_t seed = 1; seed <= (test::isBrief() ? 1 : 3); ++seed)
    for (const shapes::NamedMesh& family : shapes::families(seed)) {
      SCOPED_TRACE(family.name);
      const Fitted f = cutOf(family.mesh, 0.4);
      const FittedSurface result = fitted(f);
      EXPECT_LE(result.rmsAfter, result.rmsBefore);
      for (const auto& t : f.cut.triangles) {
        const auto normalOf = [&](const std::vector<Vec3>& at) {
          return cross(at[t[1]] - at[t[0]], at[t[2]] - at[t[0]]);
        };
        const Vec3 before = normalOf(f.cut.positions), after = normalOf(result.positions);
        EXPECT_GE(dot(before, after), (0.5 - 1e-9) * norm(before) * norm(after));
      }
    }
}

TEST(FitSurface, KeepsBordersNearBordersAndHeldVerticesToTheBit) {
  const TriangleMesh sheet = shapes::hills(30, 3);
  const FittedSurface free = fitted(cutOf(sheet, 0.2));
  const Fitted held = cutOf(sheet, 0.2, true);
  const FittedSurface kept = fitted(held);
  ASSERT_TRUE(std::ranges::count(held.isHeld, 1) > 4);
  for (std::size_t v = 0; v < held.isHeld.size(); ++v)
    EXPECT_TRUE(held.isHeld[v] == 0 || kept.positions[v] == held.cut.positions[v]) << v;
  // The sheet's plan is a square; its border stays within a fraction of a step of it.
  const auto squareOf = [](const std::vector<Vec3>& positions) {
    std::pair<double, double> square{1e9, -1e9};
    for (const Vec3& p : positions) {
      square.first = std::min({square.first, p.x, p.y});
      square.second = std::max({square.second, p.x, p.y});
    }
    return square;
  };
  EXPECT_NEAR(squareOf(free.positions).first, squareOf(sheet.positions).first, 0.25);
  EXPECT_NEAR(squareOf(free.positions).second, squareOf(sheet.positions).second, 0.25);
}

TEST(FitSurface, IsTheSameForAnyThreadsAndAnyPowerOfTwo) {
  const Fitted f = cutOf(shapes::shaken(shapes::globe(40, 20), 2, 0.01), 0.2);
  RunContext one, two;
  one.threads = 1;
  two.threads = 2;
  const FittedSurface result = fitted(f, two);
  EXPECT_EQ(fitted(f, one).positions, result.positions);
  for (const double scale : {0x1p-33, 0x1p33}) {
    Fitted scaled = f;
    for (TriangleMesh* mesh : {&scaled.source, &scaled.cut})
      for (Vec3& p : mesh->positions) p = p * scale;
    const FittedSurface other = fitted(scaled);
    for (std::size_t v = 0; v < result.positions.size(); ++v)
      ASSERT_EQ(other.positions[v], result.positions[v] * scale) << scale;
  }
}

TEST(FitSurface, RefusesWhatItCannotBeFittedTo) {
  const Fitted f = cutOf(shapes::globe(12, 7), 0.5);
  TriangleMesh flat = f.source;
  for (Vec3& p : flat.positions) p = {1, 1, 1};
  EXPECT_FALSE(fitSurface(f.cut, f.isHeld, flat));
  TriangleMesh broken = f.source;
  broken.triangles[0][0] = 1'000'000;
  EXPECT_FALSE(fitSurface(f.cut, f.isHeld, broken));
  std::atomic<bool> stop = true;
  RunContext context;
  context.cancel = &stop;
  const auto stopped = fitSurface(f.cut, f.isHeld, f.source, {}, context);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::interrupted);
}

TEST(HeldVertices, AreThoseWhereWedgesOrPartsMeet) {
  SurfaceMesh mesh(shapes::sheet(7, 5));
  for (const auto& t : mesh.triangles) {
    const bool isRight = mesh.positions[t[0]].x + mesh.positions[t[1]].x + mesh.positions[t[2]].x > 9;
    mesh.materialOf.push_back(isRight ? 1 : 0);
  }
  mesh.materials = {{.name = "a"}, {.name = "b"}};
  const auto held = heldVertices(mesh, false), withBorders = heldVertices(mesh, true);
  double width = 0, height = 0;
  for (const Vec3& p : mesh.positions) {
    width = std::max(width, p.x);
    height = std::max(height, p.y);
  }
  for (std::size_t v = 0; v < held.size(); ++v) {
    const Vec3& p = mesh.positions[v];
    EXPECT_EQ(held[v] != 0, p.x == 3) << p.x << ' ' << p.y;
    EXPECT_EQ(withBorders[v] != 0, p.x == 3 || p.x == 0 || p.x == width || p.y == 0 || p.y == height);
  }
}

}  // namespace
}  // namespace arete
