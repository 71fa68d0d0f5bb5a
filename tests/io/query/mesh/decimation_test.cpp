// SPDX-License-Identifier: GPL-3.0-or-later
//
// Requests that contradict themselves name their field; every method reaches its budget.
#include "io/query/mesh/decimation.h"

#include <gtest/gtest.h>

#include "surface/families.h"

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
  for (const char* method : {"measured", "lindstrom-turk"})
    EXPECT_EQ(refusalOf("color:1", method), "attributeWeight");
}

TEST(Decimation, WeighsColoursUnlessTheListLeavesThemOut) {
  const auto made = [](const char* list) {
    auto result = decimateMesh(painted(), {.method = "qem", .maxTriangles = 100, .attributeWeights = list});
    if (!result) throw std::runtime_error(result.error().message);
    return result->mesh;
  };
  EXPECT_TRUE(made("") == made("color:0.15"));
  EXPECT_FALSE(made("").positions == made("color:0").positions);
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
