// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers on meshes against closed forms, and against an oracle that looks at a dense grid of every triangle.
#include "measure/near_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "measure/least_on_triangle.h"
#include "terrain/measure_meshes.h"

namespace arete {
namespace {

using namespace measuring_test;

using AtPlace = std::function<std::vector<double>(const Vec3&)>;

std::vector<double> cornersBy(const TriangleMesh& mesh, const AtPlace& at) {
  std::vector<double> numbers;
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t)
      for (const double x : at(mesh.positions[v])) numbers.push_back(x);
  return numbers;
}

NumbersFound measured(const TriangleMesh& mesh, const TriangleMesh& source, ComparedNumbers numbers,
                      double within) {
  const auto found =
      measureNearNumbers(mesh, source, {std::move(numbers)}, {.within = within, .samples = 500}, {});
  EXPECT_TRUE(found) << found.error().describe();
  return found ? found->front() : NumbersFound{};
}

TEST(NearNumbers, OfTheSameMeshAreTheSame) {
  const TriangleMesh mesh = moved(soup(50, 3), {4e5, 5e6, 1000});
  for (const NumbersNorm norm :
       {NumbersNorm::largest, NumbersNorm::length, NumbersNorm::angle, NumbersNorm::equality}) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(norm == NumbersNorm::angle ? 1 : -1, 2);
    ComparedNumbers numbers{.norm = norm, .components = 3};
    for (std::size_t i = 0; i < 9 * mesh.triangles.size(); ++i) numbers.ofSource.push_back(number(random));
    numbers.ofMesh = numbers.ofSource;
    const NumbersFound found = measured(mesh, mesh, numbers, 0);
    EXPECT_LT(found.largest, 1e-6) << int(norm) << " at " << found.worst.x << ' ' << found.worst.y << ' '
                                   << found.worst.z;
    EXPECT_LT(found.meanAtNearest, 1e-6) << int(norm);
    EXPECT_EQ(found.unequal, 0) << int(norm);
  }
}

// u = x on the source and u = x + 3 on the mesh: within E the best is E nearer.
TEST(NearNumbers, ASlopeIsMadeUpForByTheDistance) {
  const TriangleMesh fine = plane(9, 10, 0), coarse = plane(2, 10, 0);
  ComparedNumbers numbers{.norm = NumbersNorm::length,
                          .components = 2,
                          .ofSource = cornersBy(fine,
                                                [](const Vec3& p) {
                                                  return std::vector{p.x, p.y};
                                                }),
                          .ofMesh = cornersBy(coarse, [](const Vec3& p) {
                            return std::vector{p.x + 3, p.y};
                          })};
  for (const double within : {0.0, 0.25, 1.0, 2.0}) {
    const NumbersFound found = measured(coarse, fine, numbers, within);
    // At x = 0 the mesh ends, and no y lies beyond.
    EXPECT_NEAR(found.largest, 3, 1e-9) << within;
    EXPECT_NEAR(found.worst.x, 0, 1e-9) << within;
    EXPECT_NEAR(found.meanAtNearest, 3, 1e-9) << within;
    // Over x > E it is 3 - E, below 3 - x.
    const double mean = (within * (3 - within / 2) + (10 - within) * (3 - within)) / 10;
    EXPECT_NEAR(found.mean, mean, 0.01) << within;
  }
}

TEST(NearNumbers, ASeamIsLookedAtFromBothSides) {
  // Two halves with numbers of their own, and a mesh of which one side of the seam is wrong at the line only.
  const TriangleMesh mesh = plane(2, 2, 0);
  const auto sides = [&](double atLine) {
    std::vector<double> numbers;
    for (const auto& t : mesh.triangles) {
      const bool isRight = (mesh.positions[t[0]].x + mesh.positions[t[1]].x + mesh.positions[t[2]].x) / 3 > 1;
      for (const std::uint32_t v : t)
        numbers.push_back(isRight ? 100 + (mesh.positions[v].x == 1 ? atLine : 0) : 0);
    }
    return numbers;
  };
  ComparedNumbers numbers{
      .norm = NumbersNorm::length, .components = 1, .ofSource = sides(0), .ofMesh = sides(0)};
  EXPECT_LT(measured(mesh, mesh, numbers, 0).largest, 1e-12);
  numbers.ofMesh = sides(-40);
  EXPECT_NEAR(measured(mesh, mesh, numbers, 0).largest, 40, 1e-9);
  EXPECT_NEAR(measured(mesh, mesh, numbers, 0.25).largest, 30, 1e-3);
}

TEST(NearNumbers, OfLabelsOnlyEqualOnesCount) {
  const TriangleMesh mesh = plane(4, 4, 0);
  std::vector<double> halves, shifted;
  for (const auto& t : mesh.triangles) {
    const double x = (mesh.positions[t[0]].x + mesh.positions[t[1]].x + mesh.positions[t[2]].x) / 3;
    halves.insert(halves.end(), 3, x > 2 ? 7 : 8);
    shifted.insert(shifted.end(), 3, x > 1 ? 7 : 8);
  }
  ComparedNumbers numbers{
      .norm = NumbersNorm::equality, .components = 1, .ofSource = halves, .ofMesh = shifted};
  const NumbersFound off = measured(mesh, mesh, numbers, 0.5);
  EXPECT_TRUE(std::isinf(off.largest));
  EXPECT_GT(off.worst.x, 1.5 - 1e-9);
  EXPECT_LE(off.worst.x, 2);
  EXPECT_FALSE(off.worstNear);
  EXPECT_EQ(measured(mesh, mesh, numbers, 1.01).unequal, 0);
}

TEST(NearNumbers, NumbersThatAreNotFiniteAreEqualToThemselvesAlone) {
  const TriangleMesh mesh = plane(1, 1, 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ComparedNumbers numbers{.norm = NumbersNorm::length,
                          .components = 1,
                          .ofSource = {nan, nan, nan, nan, nan, nan},
                          .ofMesh = {nan, nan, nan, nan, nan, nan}};
  EXPECT_EQ(measured(mesh, mesh, numbers, 0).largest, 0);
  numbers.ofMesh = {0, 0, 0, 0, 0, 0};
  EXPECT_TRUE(std::isinf(measured(mesh, mesh, numbers, 0).largest));
}

TEST(NearNumbers, APointWithoutAnotherNearIsInfinitelyFar) {
  const TriangleMesh low = plane(1, 1, 0), high = plane(1, 1, 2);
  const ComparedNumbers numbers{.norm = NumbersNorm::length,
                                .components = 1,
                                .ofSource = {1, 1, 1, 1, 1, 1},
                                .ofMesh = {1, 1, 1, 1, 1, 1}};
  EXPECT_TRUE(std::isinf(measured(high, low, numbers, 1.9).largest));
  EXPECT_LT(measured(high, low, numbers, 2).largest, 1e-12);
}

TEST(NearNumbers, PartsAreComparedAmongThemselves) {
  const TriangleMesh mesh = plane(1, 1, 0);
  ComparedNumbers numbers{.norm = NumbersNorm::length,
                          .components = 1,
                          .ofSource = {5, 5, 5, 9, 9, 9},
                          .ofMesh = {9, 9, 9, 5, 5, 5}};
  EXPECT_EQ(measured(mesh, mesh, numbers, 2).largest, 0);
  numbers.partOfSource = numbers.partOfMesh = {1, 2};
  EXPECT_EQ(measured(mesh, mesh, numbers, 2).largest, 4);
  numbers.partOfSource = {ComparedNumbers::kNotCompared, ComparedNumbers::kNotCompared};
  EXPECT_EQ(measured(mesh, mesh, numbers, 2).points, 0);
}

// The oracle tries a grid of the triangle: no point of it is nearer than what is found, and some is about as
// near.
TEST(LeastOnTriangle, IsTheLeastOfADenseGrid) {
  for (const NumbersNorm norm : {NumbersNorm::largest, NumbersNorm::length, NumbersNorm::angle})
    for (std::uint32_t seed = 0; seed < 60; ++seed) {
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> place(-1, 1), number(norm == NumbersNorm::angle ? 0.2 : -1, 1);
      SpaceTriangle t;
      for (Vec3& p : t) p = {place(random), place(random), place(random)};
      if (seed % 6 == 5) t[2] = 0.3 * t[0] + 0.7 * t[1];  // without area
      std::vector<double> corners, wanted;
      for (int i = 0; i < 9; ++i) corners.push_back(number(random));
      for (int i = 0; i < 3; ++i) wanted.push_back(number(random));
      const Vec3 x{place(random), place(random), place(random)};
      const Vec3 nearest = nearestOnTriangle(x, t);
      const double within = std::sqrt(squaredDistance(x, nearest)) + 0.05 + 0.4 * (place(random) + 1);
      LeastOnTriangle least(norm, 3);
      const auto found = least.find(t, corners, wanted, x, within, nearest, 40);
      EXPECT_LE(std::sqrt(squaredDistance(x, found.place)), within * (1 + 1e-9)) << int(norm) << ' ' << seed;
      EXPECT_LE(least.atLeast(t, corners, wanted, x, within), found.apart + 1e-9) << int(norm) << ' ' << seed;
      const double fast = least.find(t, corners, wanted, x, within, nearest, 20).apart;
      EXPECT_NEAR(fast, found.apart, norm == NumbersNorm::angle ? 0.02 : 2e-4) << int(norm) << ' ' << seed;
      double oracle = std::numeric_limits<double>::infinity();
      constexpr int n = 200;
      for (int a = 0; a <= n; ++a)
        for (int b = 0; a + b <= n; ++b) {
          // Nothing of what has no area is seen but its sides.
          if (seed % 6 == 5 && a != 0 && b != 0 && a + b != n) continue;
          const std::array<double, 3> shares = {double(a) / n, double(b) / n, 1 - double(a + b) / n};
          if (squaredDistance(x, shares[0] * t[0] + shares[1] * t[1] + shares[2] * t[2]) > within * within)
            continue;
          std::array<double, 3> there{};
          for (int c = 0; c < 3; ++c)
            for (int i = 0; i < 3; ++i) there[c] += shares[i] * corners[3 * i + c];
          double apart = 0;
          if (norm == NumbersNorm::angle) {
            double dots = 0, ll = 0, ww = 0;
            for (int c = 0; c < 3; ++c) {
              dots += there[c] * wanted[c];
              ll += there[c] * there[c];
              ww += wanted[c] * wanted[c];
            }
            apart = std::acos(std::clamp(dots / std::sqrt(ll * ww), -1.0, 1.0)) * 180 / M_PI;
          } else {
            for (int c = 0; c < 3; ++c) {
              const double d = std::abs(there[c] - wanted[c]);
              apart = norm == NumbersNorm::largest ? std::max(apart, d) : std::hypot(apart, d);
            }
          }
          oracle = std::min(oracle, apart);
        }
      EXPECT_LE(found.apart, oracle + 1e-6) << int(norm) << ' ' << seed;
      EXPECT_GE(found.apart, oracle - (norm == NumbersNorm::angle ? 2 : 0.03)) << int(norm) << ' ' << seed;
    }
}

// Where many triangles are near, the nearest are looked at first; the answer is that of all.
TEST(NearNumbers, OfManyNearTrianglesAreThoseOfAll) {
  const TriangleMesh mesh = plane(15, 1, 0);
  // A number that nothing near has: the least is at the end of E, far beyond the first triangles.
  ComparedNumbers numbers{.norm = NumbersNorm::length,
                          .components = 1,
                          .ofSource = cornersBy(mesh, [](const Vec3& p) { return std::vector{p.x}; }),
                          .ofMesh = cornersBy(mesh, [](const Vec3& p) { return std::vector{p.x + 0.5}; })};
  const NumbersFound found = measured(mesh, mesh, numbers, 0.3);
  EXPECT_NEAR(found.largest, 0.5, 1e-9);
  EXPECT_NEAR(found.mean, 0.3 * 0.35 + 0.7 * 0.2, 5e-3);
  numbers.ofMesh = numbers.ofSource;
  EXPECT_LT(measured(mesh, mesh, numbers, 0.3).largest, 1e-12);
}

TEST(NearNumbers, AreTheSameForAnyNumberOfThreads) {
  const TriangleMesh fine = sphere(20, 1), coarse = sphere(7, 1);
  const auto direction = [](const Vec3& p) { return std::vector{p.x, p.y, p.z}; };
  const std::vector<ComparedNumbers> numbers = {{.norm = NumbersNorm::angle,
                                                 .components = 3,
                                                 .ofSource = cornersBy(fine, direction),
                                                 .ofMesh = cornersBy(coarse, direction)}};
  std::vector<NumbersFound> found;
  for (const int threads : {1, 3}) {
    RunContext context;
    context.threads = threads;
    found.push_back(
        measureNearNumbers(coarse, fine, numbers, {.within = 0.3, .samples = 3000}, context).value().front());
  }
  EXPECT_EQ(found[0].largest, found[1].largest);
  EXPECT_EQ(found[0].mean, found[1].mean);
  EXPECT_EQ(found[0].rmsAtNearest, found[1].rmsAtNearest);
  EXPECT_LT(found[0].largest, 12);
  EXPECT_GE(found[0].meanAtNearest, found[0].mean);
}

}  // namespace
}  // namespace arete
