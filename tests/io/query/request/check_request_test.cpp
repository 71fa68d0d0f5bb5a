// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/request/check_request.h"

#include <gtest/gtest.h>

#include <functional>

#include "io/query/face/arete.h"
#include "surface/builder/build.h"
#include "surface/shapes.h"

namespace arete {
namespace {

struct Wrong {
  const char* culprit;
  ModelKind kind;
  std::function<void(CutRequest&)> state;
};

TEST(CheckRequest, RefusesWhatTheKindHasNotAndWhatExcludesEachOtherByTheNameOfTheField) {
  const auto region = std::make_shared<const Region>(Region::box({0, 0, 1, 1}));
  const std::vector<Wrong> all = {
      {"dropParts", ModelKind::terrain, [](CutRequest& r) { r.dropParts = 1; }},
      {"spaceCamera", ModelKind::terrain, [](CutRequest& r) { r.spaceCamera = SurfaceCamera(); }},
      {"fit", ModelKind::terrain, [](CutRequest& r) { r.fit = CutFit::rms; }},
      {"fit", ModelKind::surface, [](CutRequest& r) { r.fit = CutFit::triangles; }},
      {"fit", ModelKind::surface, [](CutRequest& r) { r.fit = CutFit::error; }},
      {"fit", ModelKind::surface, [](CutRequest& r) { r.fit = CutFit::unbiased; }},
      {"planRegion", ModelKind::surface, [&](CutRequest& r) { r.planRegion = region; }},
      {"camera", ModelKind::surface, [](CutRequest& r) { r.camera = Camera(); }},
      {"distance", ModelKind::surface, [](CutRequest& r) { r.distance = 5; }},
      {"focus", ModelKind::terrain,
       [&](CutRequest& r) {
         r.focus = CutRequest::Focus();
         r.planRegion = region;
       }},
      {"camera", ModelKind::terrain,
       [](CutRequest& r) {
         r.camera = Camera();
         r.focus = CutRequest::Focus();
         r.maxError.reset();
       }},
      {"camera", ModelKind::terrain, [](CutRequest& r) { r.camera = Camera(); }},
      {"pixelError", ModelKind::terrain, [](CutRequest& r) { r.pixelError = 1; }},
      {"importance", ModelKind::terrain, [](CutRequest& r) { r.importance = "heat"; }},
      {"importance", ModelKind::surface,
       [](CutRequest& r) {
         r.importance = "heat";
         r.method = CutMethod::saturated;
       }},
      {"importance", ModelKind::surface,
       [](CutRequest& r) {
         r.importance = "heat";
         r.fit = CutFit::rms;
       }},
      {"order", ModelKind::surface, [](CutRequest& r) { r.order = CutOrder::twoQueues; }},
      {"fit", ModelKind::terrain,
       [](CutRequest& r) {
         r.fit = CutFit::triangles;
         r.focus = CutRequest::Focus();
       }},
      {"fit", ModelKind::terrain,
       [](CutRequest& r) {
         r.fit = CutFit::triangles;
         r.maxError.reset();
         r.maxTriangles = 100;
       }},
      {"fit", ModelKind::terrain,
       [](CutRequest& r) {
         r.fit = CutFit::unbiased;
         r.deadlineMilliseconds = 5;
       }},
      {"fit", ModelKind::surface,
       [](CutRequest& r) {
         r.fit = CutFit::rms;
         r.deadlineMilliseconds = 5;
       }},
      {"fit", ModelKind::terrain,
       [](CutRequest& r) {
         r.fit = CutFit::error;
         r.region = "0,0,1,1";
       }},
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    CutRequest request{.maxError = 1};
    all[i].state(request);
    const Status checked = checkRequest(request, all[i].kind);
    ASSERT_FALSE(checked) << i;
    EXPECT_EQ(checked.error().code, ErrorCode::usage) << i;
    EXPECT_EQ(checked.error().culprit, all[i].culprit) << i << " " << checked.error().message;
  }
}

TEST(CheckRequest, LetsEveryRequestOfItsKindThrough) {
  for (const ModelKind kind : {ModelKind::terrain, ModelKind::surface}) {
    EXPECT_TRUE(checkRequest({.maxError = 1}, kind));
    EXPECT_TRUE(checkRequest({.maxError = 1, .maxTriangles = 5, .deadlineMilliseconds = 3}, kind));
    EXPECT_TRUE(checkRequest({.maxError = 1, .focus = CutRequest::Focus()}, kind));
    EXPECT_TRUE(checkRequest({.maxTriangles = 9, .region = "0,0,1,1"}, kind));
  }
  EXPECT_TRUE(checkRequest({.maxError = 1, .distance = 4, .fit = CutFit::triangles}, ModelKind::terrain));
  EXPECT_TRUE(checkRequest({.maxTriangles = 1, .fit = CutFit::error}, ModelKind::terrain));
  EXPECT_TRUE(
      checkRequest({.maxTriangles = 1, .region = "0,0,1,1", .fit = CutFit::unbiased}, ModelKind::terrain));
  EXPECT_TRUE(checkRequest({.maxTriangles = 1, .fit = CutFit::rms, .dropParts = 2}, ModelKind::surface));
}

TEST(CheckRequest, IsAskedByTheFace) {
  Result<SurfaceModel> model = buildSurface(SurfaceMesh(shapes::sheet(24, 12)));
  ASSERT_TRUE(model);
  const auto tin = cut(*model, {.maxError = 0.1, .fit = CutFit::triangles});
  ASSERT_FALSE(tin);
  EXPECT_EQ(tin.error().culprit, "fit");
}

}  // namespace
}  // namespace arete
