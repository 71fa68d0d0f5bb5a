// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/request/criterion.h"

#include <gtest/gtest.h>

#include <limits>

#include "engine/criteria/refine_order.h"
#include "engine/criteria/view_error.h"
#include "io/amt_fixture.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// On a grid of metres, so that places, boxes and distances are the same in the plan and on the ground.
TerrainModel hillyModel() {
  RasterHeightfield field = test::hills(60, 50, [](double z) { return std::round(z); });
  field.georeference.geoTransform = {0, 1, 0, 0, 0, 1};
  return test::built(build(field));
}

CutRequest within(double maxError) {
  CutRequest c;
  c.maxError = maxError;
  return c;
}

TEST(CutRequest, PromisesItsToleranceOnlyWhereNothingElseDecides) {
  EXPECT_TRUE(within(5).promisesMaxError());
  EXPECT_FALSE(CutRequest().promisesMaxError());
  CutRequest c = within(5);
  c.maxTriangles = 10;
  EXPECT_FALSE(c.promisesMaxError());
  c = within(5);
  c.deadlineMilliseconds = 10;
  EXPECT_FALSE(c.promisesMaxError());
  c = within(5);
  c.focus = CutRequest::Focus();
  EXPECT_FALSE(c.promisesMaxError());
  c = within(5);
  c.camera = Camera();
  EXPECT_FALSE(c.promisesMaxError());
}

TEST(CutRequest, IsTheEnginesWithWhatAFormatRoundsTakenOff) {
  const TerrainModel model = hillyModel();
  const auto uniform = engineCriterion(within(5), std::nullopt, 0.5, model);
  ASSERT_TRUE(uniform);
  const auto* const error = dynamic_cast<const UniformError*>(uniform->get());
  ASSERT_NE(error, nullptr);
  EXPECT_EQ(error->allowedError({0, 0, 0, 1}), 4.5);
  EXPECT_EQ((*engineCriterion(within(0.25), std::nullopt, 0.5, model))->allowedError({0, 0, 0, 1}), 0);
}

TEST(CutRequest, OfACameraIsAViewWhateverElseIsStated) {
  const TerrainModel model = hillyModel();
  CutRequest c;
  c.camera = Camera();
  c.camera->xy = {10, 10};
  c.camera->height = 500;
  c.pixelError = 2;
  const auto view = engineCriterion(c, std::nullopt, 0, model);
  ASSERT_TRUE(view) << view.error().describe();
  EXPECT_NE(dynamic_cast<const ViewError*>(view->get()), nullptr);
  c.camera->verticalFieldOfViewDegrees = 0;
  EXPECT_EQ(engineCriterion(c, std::nullopt, 0, model).error().code, ErrorCode::usage);
}

TEST(CutRequest, RequiresAnErrorOfBoxesWhereAToleranceDecides) {
  const TerrainModel model = hillyModel();
  const auto everywhere = requiredBy(std::vector{within(5), within(2)}, std::nullopt, model);
  ASSERT_TRUE(everywhere && *everywhere);
  EXPECT_EQ((*everywhere)(overPlan({0, 0, 1, 1})), 2);

  CutRequest focus = within(1);
  focus.focus = {.xy = {10, 10}, .growth = 1};
  const auto around = requiredBy(std::vector{focus}, std::nullopt, model);
  ASSERT_TRUE(around && *around);
  const double near = (*around)(overPlan({9, 9, 11, 11})), far = (*around)(overPlan({49, 39, 51, 41}));
  EXPECT_LE(near, 2);
  EXPECT_GT(far, 20);

  CutRequest outside = within(1);
  outside.outsideError = kInfinity;
  const Region region = Region::box({5, 5, 15, 15});
  const auto inside = requiredBy(std::vector{outside}, region, model);
  ASSERT_TRUE(inside && *inside);
  EXPECT_EQ((*inside)(overPlan({6, 6, 7, 7})), 1);
  EXPECT_EQ((*inside)(overPlan({40, 40, 41, 41})), kInfinity);
}

TEST(CutRequest, RequiresEverythingWhereMoreThanAToleranceDecides) {
  const TerrainModel model = hillyModel();
  CutRequest budget, camera = within(1), fit = within(1);
  budget.maxTriangles = 10;
  camera.camera.emplace();
  fit.fit = CutFit::error;
  for (const CutRequest& c : {budget, camera, fit}) {
    const auto required = requiredBy(std::vector{within(1), c}, std::nullopt, model);
    ASSERT_TRUE(required);
    EXPECT_FALSE(*required);
  }
}

TEST(CutRequest, HasTheEnginesOptions) {
  const TerrainModel model = hillyModel();
  CutRequest c = within(1);
  EXPECT_EQ(engineOptions(c, model)->order, nullptr);
  EXPECT_FALSE(engineOptions(c, model)->deadline);
  c.method = CutMethod::saturated;
  c.maxTriangles = 9;
  c.deadlineMilliseconds = 5;
  c.order = CutOrder::breadth;
  const auto options = engineOptions(c, model);
  ASSERT_TRUE(options);
  EXPECT_EQ(options->method, CutMethod::saturated);
  EXPECT_EQ(options->maxTriangles, 9u);
  EXPECT_TRUE(options->deadline);
  EXPECT_NE(dynamic_cast<const BreadthFirst*>(options->order.get()), nullptr);
}

TEST(CutRequest, NeedsACameraForTwoQueuesAndNamesTheField) {
  const TerrainModel model = hillyModel();
  CutRequest c = within(1);
  c.order = CutOrder::twoQueues;
  const auto refused = engineOptions(c, model);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::usage);
  EXPECT_EQ(refused.error().culprit, "order");
  c.camera = Camera();
  c.camera->height = 500;
  EXPECT_TRUE(engineOptions(c, model));
}

TEST(CutRequest, NamesItsFits) {
  EXPECT_EQ(fitName(CutFit::none), "none");
  EXPECT_EQ(fitName(CutFit::triangles), "triangles");
  EXPECT_EQ(fitName(CutFit::error), "error");
  EXPECT_EQ(fitName(CutFit::unbiased), "unbiased");
}

}  // namespace
}  // namespace arete
