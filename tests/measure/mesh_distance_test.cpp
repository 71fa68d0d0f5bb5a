// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distances between meshes against closed forms, and against the oracle of measure_meshes.h.
#include "measure/mesh_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "measure/surface_samples.h"
#include "terrain/measure_meshes.h"

namespace arete {
namespace {

using namespace measuring_test;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

MeshDistanceReport measured(const TriangleMesh& a, const TriangleMesh& b, const MeshDistanceOptions& options,
                            std::vector<double>* vertexDistances = nullptr) {
  const auto report = measureDistance(a, b, options, {}, vertexDistances);
  EXPECT_TRUE(report) << report.error().describe();
  return report.value_or(MeshDistanceReport{});
}

void expectSame(const DistanceOneWay& a, const DistanceOneWay& b) {
  EXPECT_EQ(a.maximum, b.maximum);
  EXPECT_EQ(a.atMost, b.atMost);
  EXPECT_EQ(a.mean, b.mean);
  EXPECT_EQ(a.rms, b.rms);
  EXPECT_EQ(a.maximumAtVertices, b.maximumAtVertices);
  EXPECT_EQ(a.worst, b.worst);
  EXPECT_EQ(a.worstNearest, b.worstNearest);
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.vertices, b.vertices);
}

TEST(MeshDistance, OfAMeshToItselfIsZero) {
  const TriangleMesh mesh = moved(soup(200, 4), {4e5, 5e6, 1000});
  const MeshDistanceReport report = measured(mesh, mesh, {.samples = 20000});
  EXPECT_LT(report.hausdorff(), 1e-8);
  EXPECT_EQ(report.forward.maximumAtVertices, 0);
  EXPECT_TRUE(checkDistance(report, 0));
}

// Triangles of the one lie across edges of the other. Halves in the middle settle no such part before the
// search ends early; cuts at the edges do.
TEST(FarthestDistance, IsProvenWhereTriangulationsOfOneSurfaceDiffer) {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const auto angle = [&] { return double(random() % 6283) / 1000; };
    const double first = angle(), second = angle(), rise = double(random() % 3);
    // A roof whose ridge is on edges of both, turned.
    const auto roof = [&](std::uint32_t n) {
      return sheet(n, [&](double u, double v) {
        const Vec3 p{u, v, rise * std::min(u, 1 - u)};
        const Vec3 turned{std::cos(first) * p.x - std::sin(first) * p.y,
                          std::sin(first) * p.x + std::cos(first) * p.y, p.z};
        return Vec3{turned.x, std::cos(second) * turned.y - std::sin(second) * turned.z,
                    std::sin(second) * turned.y + std::cos(second) * turned.z};
      });
    };
    const TriangleMesh coarse = roof(4), fine = roof(14);
    for (const auto& [from, to] : {std::pair{&coarse, &fine}, std::pair{&fine, &coarse}}) {
      const Result<double> distance = farthestDistance(*from, *to, {}, 200'000);
      ASSERT_TRUE(distance);
      // The diagonal of the box of what is turned is longer, by the root of 3 at most.
      EXPECT_LE(*distance, 1e-5 * std::sqrt(3 * (2 + rise * rise / 4)));
    }
    // One corner of the fine one stands off the roof by 1.
    TriangleMesh dented = fine;
    const auto dent = static_cast<std::size_t>(random() % fine.positions.size());
    const Vec3 up{0, -std::sin(second), std::cos(second)};
    dented.positions[dent] = dented.positions[dent] + up;
    const Result<double> distance = farthestDistance(dented, coarse, {}, 200'000);
    ASSERT_TRUE(distance);
    const auto most = double(distanceTo(dented.positions[dent], coarse));
    EXPECT_GE(*distance, most * (1 - 1e-12));
    EXPECT_LE(*distance, most * 1.001);
  }
}

TEST(MeshDistance, OfParallelPlanesIsTheirGapEverywhere) {
  // Different triangulations of one square, far from the origin of a projected CRS.
  const Vec3 utm{432100.25, 5123456.5, 812.125};
  const MeshDistanceReport report =
      measured(moved(plane(3, 1000, 0), utm), moved(plane(7, 1000, 2.5), utm), {.samples = 10000});
  for (const DistanceOneWay& way : {report.forward, report.backward}) {
    EXPECT_NEAR(way.maximum, 2.5, 1e-9);
    EXPECT_NEAR(way.mean, 2.5, 1e-9);
    EXPECT_NEAR(way.rms, 2.5, 1e-9);
    EXPECT_NEAR(way.maximumAtVertices, 2.5, 1e-9);
    EXPECT_EQ(way.samples, 10000u);
  }
  EXPECT_NEAR(report.hausdorff(), 2.5, 1e-9);
  EXPECT_NEAR(report.first.area, 1e6, 1e-3);
  EXPECT_NEAR(report.second.diagonal, 1000 * std::numbers::sqrt2, 1e-6);
  EXPECT_EQ(report.first.triangles, 18u);
  EXPECT_EQ(report.second.vertices, 64u);
  EXPECT_TRUE(checkDistance(report, 2.5));
  EXPECT_FALSE(checkDistance(report, 2.4999999));
}

TEST(MeshDistance, OfAWedgeHasTheMeanAndRmsOfALinearFunction) {
  // The plane z = x / 2 is wider than the square, so that every foot lies on it: distance = x sin(atan(1/2)).
  const TriangleMesh flat = plane(5, 1, 0);
  const TriangleMesh tilted = sheet(4, [](double u, double v) {
    return Vec3{4 * u - 2, 4 * v - 2, (4 * u - 2) / 2};
  });
  const double sine = 1 / std::sqrt(5.0);
  const MeshDistanceReport report = measured(flat, tilted, {.samples = 200000});
  EXPECT_NEAR(report.forward.maximum, sine, 1e-12);
  EXPECT_NEAR(report.forward.mean, sine / 2, 1e-4 * sine);
  EXPECT_NEAR(report.forward.rms, sine / std::sqrt(3.0), 1e-4 * sine);
  // From the plane's corner (-2, -2, -1) the square's (0, 0, 0) is nearest.
  EXPECT_NEAR(report.backward.maximum, 3, 1e-12);
  EXPECT_EQ(report.hausdorff(), report.backward.maximum);
  EXPECT_EQ(report.backward.worst, (Vec3{-2, -2, -1}));
  EXPECT_NEAR(report.backward.worstNearest.x, 0, 1e-12);
  EXPECT_NEAR(report.mean(),
              (report.forward.mean * report.first.area + report.backward.mean * report.second.area) /
                  (report.first.area + report.second.area),
              1e-12);
}

TEST(MeshDistance, OfConcentricSpheresIsTheDifferenceOfTheirRadii) {
  const MeshDistanceReport report = measured(sphere(120, 1), sphere(100, 1.5), {.samples = 20000});
  for (const DistanceOneWay& way : {report.forward, report.backward}) {
    EXPECT_NEAR(way.maximum, 0.5, 2e-3);
    EXPECT_NEAR(way.mean, 0.5, 2e-3);
    EXPECT_NEAR(way.rms, 0.5, 2e-3);
  }
  // The samples of the outer sphere lie inside it, on its chords.
  EXPECT_LT(report.backward.mean, 0.5);
}

TEST(MeshDistance, AgreesWithTheOracleOnEverySample) {
  for (const std::uint64_t seed : {1u, 2u}) {
    const TriangleMesh a = soup(40, seed), b = soup(50, seed + 10);
    const MeshDistanceReport report = measured(a, b, {.samples = 2000, .seed = seed});
    const SurfaceSamples samples(a, 2000, seed);  // nearly: the library moves the meshes first
    Real sum = 0, squares = 0, most = 0;
    std::uint32_t triangle = 0;
    for (std::uint64_t i = 0; i < samples.count(); ++i) {
      const Real distance = distanceTo(samples.at(i, triangle), b);
      sum += distance;
      squares += distance * distance;
      most = std::max(most, distance);
    }
    Real atVertices = 0;
    for (const Vec3& p : a.positions) atVertices = std::max(atVertices, distanceTo(p, b));
    EXPECT_NEAR(report.forward.mean, double(sum / 2000), 1e-9);
    EXPECT_NEAR(report.forward.rms, double(std::sqrt(squares / 2000)), 1e-9);
    EXPECT_NEAR(report.forward.maximumAtVertices, double(atVertices), 1e-9);
    EXPECT_GE(report.forward.maximum, double(std::max(most, atVertices)) - 1e-9);
    EXPECT_NEAR(double(distanceTo(report.forward.worst, b)), report.forward.maximum, 1e-9);
    Real offSurface = std::numeric_limits<Real>::infinity();
    for (const auto& t : a.triangles)
      offSurface = std::min(offSurface, distanceTo(report.forward.worst, a.positions[t[0]], a.positions[t[1]],
                                                   a.positions[t[2]]));
    EXPECT_NEAR(double(offSurface), 0, 1e-9);
    const MeshDistanceReport sampled = measured(a, b, {.samples = 2000, .seed = seed, .accuracy = kInfinity});
    EXPECT_NEAR(sampled.forward.maximum, double(std::max(most, atVertices)), 1e-9);
    EXPECT_EQ(sampled.forward.mean, report.forward.mean);
    EXPECT_EQ(sampled.hausdorffAtMost(), kInfinity);
  }
}

TEST(MeshDistance, FindsTheFarthestPointInsideATriangle) {
  // A square of two triangles over a frame without an inside: its centre, which no few samples hit, is 1/2
  // away.
  TriangleMesh frame = plane(1, 1, 0);
  frame.positions = {{0, 0, 0},   {1, 0, 0},  {0, 1, 0},  {1, 1, 0},
                     {-1, -1, 0}, {2, -1, 0}, {-1, 2, 0}, {2, 2, 0}};
  frame.triangles = {{4, 5, 1}, {4, 1, 0}, {5, 7, 3}, {5, 3, 1}, {7, 6, 2}, {7, 2, 3}, {6, 4, 0}, {6, 0, 2}};
  for (const double turn : {0.0, 0.3}) {
    // Moved a little, so that no corner or middle of a side falls on the centre.
    const TriangleMesh square = sheet(1, [&](double u, double v) {
      return Vec3{u + turn * (v - 0.4), v, 0};
    });
    const MeshDistanceReport report = measured(square, frame, {.samples = 50});
    EXPECT_NEAR(report.forward.maximum, 0.5, 5e-4);
    EXPECT_GE(report.forward.atMost, 0.5 - 1e-12);
    EXPECT_LE(report.forward.atMost, 1.001 * report.forward.maximum + 1e-12);
    EXPECT_NEAR(report.forward.worst.x, 0.5, 2e-3);
    EXPECT_NEAR(report.forward.worst.y, 0.5, 2e-3);
  }
}

TEST(MeshDistance, BoundsTheMaximumFromBothSides) {
  const auto hill = [](double u, double v) { return Vec3{u, v, 0.3 * std::sin(5 * u) * std::sin(4 * v)}; };
  for (const auto& [name, a, b] :
       {std::tuple("soups", soup(40, 8), soup(30, 9)), std::tuple("hills", sheet(5, hill), sheet(40, hill)),
        std::tuple("spheres", sphere(20, 1), moved(sphere(30, 1), {0.2, 0, 0})),
        std::tuple("planes", plane(1, 1, 0), plane(3, 1, 0.1))}) {
    SCOPED_TRACE(name);
    const MeshDistanceReport report = measured(a, b, {.samples = 3000});
    const MeshDistanceReport dense = measured(a, b, {.samples = 300000, .seed = 7, .accuracy = kInfinity});
    for (const auto& [way, sampled] :
         {std::pair(report.forward, dense.forward), std::pair(report.backward, dense.backward)}) {
      EXPECT_LE(sampled.maximum, way.atMost + 1e-12);
      EXPECT_GE(way.maximum, sampled.maximum * (1 - 1e-3) - 1e-12);
      EXPECT_LE(way.maximum, way.atMost);
      EXPECT_LE(way.atMost, 1.001 * way.maximum + 1e-5 * report.second.diagonal);
    }
  }
}

TEST(MeshDistance, IsHonestWhereTheBudgetIsSpent) {
  // Two shifted grids in one plane: every distance is zero, but no triangle of one lies in one of the other.
  const MeshDistanceReport report =
      measured(plane(7, 1, 0), moved(plane(11, 3, 0), {-1, -1.05, 0}), {.samples = 10});
  EXPECT_LT(report.forward.maximum, 1e-12);
  EXPECT_LT(report.forward.atMost, 0.1);
  EXPECT_GE(report.forward.atMost, report.forward.maximum);
}

TEST(MeshDistance, BarelyDependsOnTheSeedAndTheCount) {
  const auto hill = [](double u, double v) { return Vec3{u, v, 0.3 * std::sin(5 * u) * std::sin(4 * v)}; };
  const TriangleMesh fine = sheet(60, hill), coarse = sheet(9, hill);
  const MeshDistanceReport reference = measured(coarse, fine, {.samples = 1000000});
  for (const std::uint64_t seed : {2u, 3u, 4u}) {
    const MeshDistanceReport report = measured(coarse, fine, {.samples = 50000, .seed = seed});
    EXPECT_NEAR(report.forward.mean / reference.forward.mean, 1, 2e-3) << seed;
    EXPECT_NEAR(report.backward.rms / reference.backward.rms, 1, 2e-3) << seed;
    EXPECT_NEAR(report.hausdorff() / reference.hausdorff(), 1, 2e-2) << seed;
    EXPECT_EQ(report.seed, seed);
  }
}

TEST(MeshDistance, IsTheSameFromBothSidesAndForAnyNumberOfThreads) {
  const TriangleMesh a = moved(soup(300, 5), {1e6, 2e6, 0}), b = moved(sphere(20, 1), {1e6, 2e6, 0.3});
  const MeshDistanceReport once = measured(a, b, {.samples = 30000}),
                           turned = measured(b, a, {.samples = 30000});
  expectSame(once.forward, turned.backward);
  expectSame(once.backward, turned.forward);
  EXPECT_EQ(once.hausdorff(), turned.hausdorff());
  for (const int threads : {1, 2, 4}) {
    RunContext context;
    context.threads = threads;
    std::vector<double> distances;
    const auto report = measureDistance(a, b, {.samples = 30000}, context, &distances);
    ASSERT_TRUE(report);
    expectSame(report->forward, once.forward);
    expectSame(report->backward, once.backward);
    ASSERT_EQ(distances.size(), a.positions.size());
    EXPECT_EQ(*std::ranges::max_element(distances), once.forward.maximumAtVertices);
  }
}

TEST(MeshDistance, LeavesUnusedVerticesOutOfTheStatisticsAndMeasuresThem) {
  TriangleMesh a = plane(2, 1, 0);
  a.positions.push_back({0.5, 0.5, 700});
  std::vector<double> distances;
  const MeshDistanceReport report = measured(a, plane(3, 1, 1), {.samples = 100}, &distances);
  EXPECT_NEAR(report.forward.maximum, 1, 1e-12);
  EXPECT_NEAR(report.first.diagonal, std::numbers::sqrt2, 1e-12);
  EXPECT_EQ(report.first.unusedVertices, 1u);
  EXPECT_EQ(report.forward.vertices, 9u);
  ASSERT_EQ(distances.size(), 10u);
  EXPECT_NEAR(distances.back(), 699, 1e-9);
}

TEST(MeshDistance, CountsTrianglesWithoutAreaAndIsNearToThem) {
  TriangleMesh spike = plane(1, 1, 0);
  spike.positions.push_back({0, 0, 5});
  spike.triangles.push_back({0, 4, 0});  // a segment that stands up
  const MeshDistanceReport report = measured(spike, plane(1, 1, 5), {.samples = 1000});
  EXPECT_EQ(report.first.degenerateTriangles, 1u);
  EXPECT_NEAR(report.first.area, 1, 1e-12);
  EXPECT_NEAR(report.forward.mean, 5, 1e-12);
  EXPECT_LT(report.backward.mean, 5);
  EXPECT_NEAR(report.forward.maximum, 5, 1e-12);
}

TEST(MeshDistance, ChoosesAMillionSamplesOrTenPerTriangle) {
  const MeshDistanceReport report = measured(plane(1, 1, 0), plane(1, 1, 1), {});
  EXPECT_EQ(report.forward.samples, 1000000u);
  EXPECT_EQ(report.backward.samples, 1000000u);
}

TEST(MeshDistance, RefusesMeshesThatMakeNoSense) {
  const TriangleMesh good = plane(2, 1, 0);
  const auto refused = [&](const TriangleMesh& a, const TriangleMesh& b) {
    const auto report = measureDistance(a, b, {.samples = 100});
    EXPECT_FALSE(report);
    return report ? Error{} : report.error();
  };
  EXPECT_EQ(refused({}, good).describe(), "first: holds no triangle");
  EXPECT_EQ(refused(good, {}).describe(), "second: holds no triangle");
  TriangleMesh line = good;
  line.triangles = {{0, 1, 2}};
  EXPECT_EQ(refused(good, line).describe(), "second: holds no triangle that has area");
  EXPECT_EQ(refused(good, line).code, ErrorCode::degenerate);
  TriangleMesh nan = good;
  nan.positions[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused(nan, good).code, ErrorCode::invalidData);
  TriangleMesh index = good;
  index.triangles[0][1] = 99;
  EXPECT_NE(refused(good, index).message.find("names vertex 99"), std::string::npos);
  EXPECT_EQ(refused(plane(2, 1e200, 0), good).code, ErrorCode::invalidData);
  EXPECT_EQ(refused(good, moved(good, {0, 0, 1e100})).code, ErrorCode::invalidData);
}

TEST(MeshDistance, TellsItsProgressAndStopsWhenAsked) {
  std::atomic<bool> cancel{false};
  RunContext context;
  context.cancel = &cancel;
  double last = 0;
  context.progress = [&](std::string_view, double fraction) {
    last = fraction;
    cancel = true;
  };
  const auto report = measureDistance(plane(2, 1, 0), plane(2, 1, 1), {.samples = 1000000}, context);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::interrupted);
  EXPECT_GT(last, 0);
  EXPECT_LT(last, 1);
}

TEST(MeshDistance, PromisesAreCheckedAgainstTheLargerWay) {
  const MeshDistanceReport report = measured(plane(1, 1, 0), plane(1, 2, 0), {.samples = 1000});
  EXPECT_EQ(report.forward.maximum, 0);
  EXPECT_NEAR(report.backward.maximum, std::numbers::sqrt2, 1e-12);
  const Status broken = checkDistance(report, 1.4);
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().code, ErrorCode::brokenPromise);
  EXPECT_NE(broken.error().message.find("of the second mesh"), std::string::npos) << broken.error().message;
  EXPECT_TRUE(checkDistance(report, kInfinity));
  EXPECT_FALSE(checkDistance(report, std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace
}  // namespace arete
