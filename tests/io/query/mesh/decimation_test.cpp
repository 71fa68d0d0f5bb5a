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

}  // namespace
}  // namespace arete
