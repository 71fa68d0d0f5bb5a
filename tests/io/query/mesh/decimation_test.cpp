// SPDX-License-Identifier: GPL-3.0-or-later
//
// Requests that contradict themselves name their field; every method reaches its budget.
#include "io/query/mesh/decimation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "surface/families.h"
#include "surface/parted.h"

namespace arete {
namespace {

std::string culpritOf(const DecimationRequest& request) {
  const Status checked = checkDecimation(request);
  return checked ? "" : checked.error().culprit;
}

TEST(Decimation, RefusesWhatAMethodDoesNotHave) {
  const DecimationRequest budget{.maxTriangles = 50};
  EXPECT_EQ(culpritOf(budget), "");
  EXPECT_FALSE(checkDecimation({}));
  auto with = [&](auto change) {
    DecimationRequest request = budget;
    change(request);
    return culpritOf(request);
  };
  EXPECT_EQ(with([](auto& r) { r.method = "best"; }), "operator");
  EXPECT_EQ(with([](auto& r) { r.queue = "eager"; }), "queue");
  EXPECT_EQ(with([](auto& r) { r.queue = "greedy"; }), "queue");
  EXPECT_EQ(with([](auto& r) { r.quadricWeight = "none"; }), "quadricWeight");
  EXPECT_EQ(with([](auto& r) { r.clusterVertices = "original"; }), "clusterVertices");
  EXPECT_EQ(with([](auto& r) { r.forbidsCrossings = true; }), "noCrossings");
  EXPECT_EQ(with([](auto& r) { r.method = "cluster", r.keepsBorders = true; }), "keepBorders");
  EXPECT_EQ(with([](auto& r) { r.method = "qem", r.maxError = StatedSize{"1", 1, false}; }), "maxError");
  EXPECT_EQ(with([](auto& r) { r.method = "qem", r.queue = "greedy"; }), "");
}

TEST(Decimation, ByEveryMethodReachesItsBudgetOrSaysWhatItReaches) {
  const SurfaceMesh ball(shapes::globe(24, 12));
  for (const char* method :
       {"measured", "qem", "lindstrom-turk", "half-edge", "vertex-pair", "face", "cluster"}) {
    SCOPED_TRACE(method);
    const auto made = decimateMesh(ball, {.method = method, .maxTriangles = 100});
    ASSERT_TRUE(made) << made.error().describe();
    EXPECT_LE(made->mesh.triangles.size(), 100u);
    EXPECT_GT(made->mesh.triangles.size(), 8u);
    EXPECT_EQ(made->vertexOf.size(), made->mesh.positions.size());
    EXPECT_EQ(made->fit.has_value(), std::string(method) == "measured");
  }
  const auto tooFew = decimateMesh(ball, {.method = "qem", .maxTriangles = 1});
  ASSERT_FALSE(tooFew);
  EXPECT_EQ(tooFew.error().culprit, "maxTriangles 1");
}

SurfaceMesh painted() {
  SurfaceMesh mesh(shapes::globe(24, 12));
  Attribute color{.name = "color", .meaning = AttributeMeaning::color, .components = 3};
  Attribute zone{.name = "zone", .type = ScalarType::int32};
  for (const Vec3& p : mesh.positions) {
    color.append(std::vector<double>{p.x > 0 ? 1.0 : 0.0, 0, 0});
    zone.append(std::vector<double>{3});
  }
  mesh.vertexAttributes = {color, zone};
  return mesh;
}

TEST(Decimation, RefusesWeightsOfWhatHasNoneAndNamesThem) {
  const auto refusalOf = [](const char* list, const char* method = "qem") {
    const auto made =
        decimateMesh(painted(), {.method = method, .maxTriangles = 100, .attributeWeights = list});
    return made ? std::string() : made.error().culprit;
  };
  EXPECT_EQ(refusalOf("color:0.5"), "");
  EXPECT_EQ(refusalOf("uv:1"), "attributeWeight uv");
  EXPECT_EQ(refusalOf("color"), "attributeWeight color");
  EXPECT_EQ(refusalOf("color:-1"), "attributeWeight color:-1");
  EXPECT_EQ(refusalOf("color:nan"), "attributeWeight color:nan");
  EXPECT_EQ(refusalOf("color:2px"), "attributeWeight color:2px");
  EXPECT_EQ(refusalOf("zone:1"), "attributeWeight zone:1");
  EXPECT_EQ(refusalOf("color:1,color:2"), "attributeWeight color:2");
  EXPECT_EQ(refusalOf("color:0.5", "measured"), "");
  EXPECT_EQ(refusalOf("zone:1", "measured"), "attributeWeight zone:1");
  EXPECT_EQ(refusalOf("color:1", "lindstrom-turk"), "attributeWeight");
}

TEST(Decimation, WeighsColoursUnlessTheListLeavesThemOut) {
  for (const char* method : {"measured", "qem"}) {
    SCOPED_TRACE(method);
    const auto made = [&](const char* list) {
      auto result =
          decimateMesh(painted(), {.method = method, .maxTriangles = 100, .attributeWeights = list});
      if (!result) throw std::runtime_error(result.error().message);
      return result->mesh;
    };
    EXPECT_TRUE(made("") == made("color:0.15"));
    EXPECT_FALSE(made("").positions == made("color:0").positions);
  }
}

TEST(Decimation, WithinADistanceCountsShapeAloneUnlessWeightsAreStated) {
  const auto made = [](const char* list) {
    auto result =
        decimateMesh(painted(), {.maxError = StatedSize{"1%", 0.01, true}, .attributeWeights = list});
    if (!result) throw std::runtime_error(result.error().message);
    return result->mesh;
  };
  EXPECT_TRUE(made("") == made("color:0"));
  EXPECT_FALSE(made("").positions == made("color:0.5").positions);
}

// A picture that repeats has coordinates that are as many times larger.
TEST(Decimation, WeighsTextureCoordinatesAlikeHoweverOftenThePictureRepeats) {
  const auto made = [](const char* method, double times) {
    SurfaceMesh mesh(shapes::globe(24, 12));
    Attribute coords{.name = "texcoord",
                     .meaning = AttributeMeaning::textureCoords,
                     .type = ScalarType::float64,
                     .components = 2};
    for (const Vec3& p : mesh.positions)
      coords.append(std::vector<double>{times * (p.x + p.y * p.y), times * (p.z - 0.4 * p.x)});
    mesh.vertexAttributes = {coords};
    const auto result = decimateMesh(mesh, {.method = method, .maxTriangles = 100});
    if (!result) throw std::runtime_error(result.error().message);
    return result->mesh.triangles;
  };
  for (const char* method : {"measured", "qem"}) {
    const auto eight = made(method, 8);
    EXPECT_EQ(eight, made(method, 64)) << method;
    EXPECT_EQ(eight, made(method, 65536)) << method;
  }
}

// Two colours that a wave divides on a plate: its shape needs two triangles.
TEST(Decimation, ByMeasuredKeepsWhatIsPaintedOnAPlate) {
  SurfaceMesh mesh(shapes::sheet(30, 30));
  Attribute color{.name = "color", .meaning = AttributeMeaning::color, .components = 3};
  const auto paint = [](const Vec3& p) { return p.y > 15 + 6 * std::sin(p.x / 6) ? 1.0 : 0.0; };
  for (const Vec3& p : mesh.positions) color.append(std::vector<double>{paint(p), 0.5, 0});
  mesh.vertexAttributes = {color};
  const auto deviationOf = [&](const char* list) {
    const auto made = decimateMesh(mesh, {.maxTriangles = 90, .attributeWeights = list});
    if (!made) throw std::runtime_error(made.error().message);
    const SurfaceMesh& result = made->mesh;
    double sum = 0;
    for (double x = 0.5; x < 30; ++x)
      for (double y = 0.5; y < 30; ++y) {
        double shown = 0;
        for (const auto& [i, j, k] : result.triangles) {
          const Vec3 &a = result.positions[i], &b = result.positions[j], &c = result.positions[k];
          const auto half = [&](const Vec3& p, const Vec3& q) {
            return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
          };
          const double u = half(b, c), v = half(c, a), w = half(a, b), all = u + v + w;
          if (all == 0 || u / all < 0 || v / all < 0 || w / all < 0) continue;
          const auto red = [&](std::uint32_t e) { return result.vertexAttributes[0].numbers(e)[0]; };
          shown = (u * red(i) + v * red(j) + w * red(k)) / all;
        }
        sum += std::abs(shown - paint({x, y, 0}));
      }
    return sum / 900;
  };
  EXPECT_LT(deviationOf(""), 0.2 * deviationOf("color:0"));
}

// No seam is where a picture is mirrored: the shape does not see it, and a triangle across it smears it.
TEST(Decimation, ByMeasuredKeepsTheLineAboutWhichAPictureIsMirrored) {
  SurfaceMesh mesh(shapes::sheet(30, 20));
  Attribute coords{.name = "texcoord",
                   .meaning = AttributeMeaning::textureCoords,
                   .type = ScalarType::float64,
                   .components = 2};
  const auto wanted = [](const Vec3& p) { return std::array{std::abs(p.x - 12) / 18, p.y / 20}; };
  for (Vec3& p : mesh.positions) {
    p.z = 0;
    coords.append(wanted(p));
  }
  mesh.vertexAttributes = {coords};
  const auto made = decimateMesh(mesh, {.maxTriangles = 12});
  ASSERT_TRUE(made);
  EXPECT_LE(made->mesh.triangles.size(), 12u);
  for (const auto& corners : made->mesh.triangles) {
    double left = 0, right = 0;
    for (const std::uint32_t v : corners) {
      const Vec3& p = made->mesh.positions[v];
      left = std::max(left, 12 - p.x);
      right = std::max(right, p.x - 12);
      EXPECT_NEAR(made->mesh.vertexAttributes[0].numbers(v)[0], wanted(p)[0], 1e-6);
    }
    EXPECT_LT(std::min(left, right), 1e-6);
  }
}

// What is stated of a fit whose lines move, by an oracle that shares nothing with it.
TEST(Decimation, ByMeasuredStatesADistanceToThePartAndItsLines) {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const parted::RandomSurface random = parted::randomSurface(seed);
    SCOPED_TRACE(random.name);
    const auto most = static_cast<std::uint32_t>(random.mesh.triangles.size() / 2);
    const auto made = decimateMesh(random.mesh, {.maxTriangles = most});
    if (!made) continue;  // lines keep more
    ASSERT_TRUE(made->fit);
    std::mt19937_64 places(seed);
    const auto broken =
        parted::violation(parted::samplesOf(random.mesh, places), made->mesh, made->fit->distance);
    EXPECT_FALSE(broken) << *broken;
  }
}

TEST(Decimation, SaysWhatLinesCostWhereTheyStopABudget) {
  SurfaceMesh mesh(shapes::globe(24, 12));
  mesh.materials = {{.name = "a"}, {.name = "b"}};
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) mesh.materialOf.push_back(t / 2 % 2);
  for (const char* method : {"qem", "measured"}) {
    const auto refused = decimateMesh(mesh, {.method = method, .maxTriangles = 8});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("lines between attributes and parts cost"), std::string::npos)
        << refused.error().message;
  }
}

}  // namespace
}  // namespace arete
