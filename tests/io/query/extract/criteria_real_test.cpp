// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every criterion, every order and the incremental cut on real terrain: projected, geographic with voids,
// lidar.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <random>

#include "engine/cut_promises.h"
#include "engine/follow/incremental_cut.h"
#include "io/geo/dem/dem_reader.h"
#include "io/io_fixture.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

class RealCriteria : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const std::filesystem::path path = test::realData(GetParam());
    if (path.empty()) GTEST_SKIP() << "the real DEMs are not here (../shared/data or $ARETE_DATA)";
    SourceReading reading;
    reading.band = 1;
    const auto dem = readDem(path.string(), reading);
    ASSERT_TRUE(dem) << dem.error().describe();
    auto model = build(std::get<RasterHeightfield>(dem->heightfield));
    ASSERT_TRUE(model) << model.error().describe();
    model_ = std::move(*model);
  }
  const MultiTriangulation& mt() const { return model_->mt; }

  std::optional<TerrainModel> model_;
};

/// Every criterion, by both kinds of cut.
void expectCriteriaMet(const MultiTriangulation& mt) {
  std::mt19937_64 random(21);
  for (const auto& [name, criterion] : criteriaFor(mt, random)) {
    SCOPED_TRACE(name);
    expectCutsKept(mt, *criterion);
  }
}

void expectOrdersWithinBudgetAndDeadline(const MultiTriangulation& mt) {
  std::mt19937_64 random(22);
  const DomainExtent domain = domainExtent(mt);
  TwoQueues::Options queues;
  queues.view = randomView(Extent(mt), random);
  const std::vector<std::shared_ptr<const RefineOrder>> orders = {
      std::make_shared<WorstFirst>(), std::make_shared<BreadthFirst>(), std::make_shared<DepthFirst>(),
      std::make_shared<TwoQueues>(queues)};
  for (const auto& order : orders) {
    const std::uint32_t budget = mt.rootTriangleCount() + 20'000;
    const auto cut = takeCut(mt, UniformError(0), {.maxTriangles = budget, .order = order});
    ASSERT_TRUE(cut);
    EXPECT_LE(cut->triangles.size(), budget);
    EXPECT_TRUE(validateFront(mt, *cut, domain));
    const auto stopped = takeCut(mt, UniformError(0), {.deadline = strikeAfter(5000), .order = order});
    ASSERT_TRUE(stopped);
    EXPECT_LE(stopped->nodes, 5000u);
    EXPECT_TRUE(validateFront(mt, *stopped, domain));
  }
  // Worst first: no uniform cut of that size is more than a tenth better.
  const std::uint32_t budget = mt.rootTriangleCount() + 30'000;
  const auto best = takeCut(mt, UniformError(0), {.maxTriangles = budget});
  ASSERT_TRUE(best);
  EXPECT_GT(takeCut(mt, UniformError(0.9 * best->achievedError))->triangles.size(), budget);
}

/// A flight over the middle of the terrain.
void expectFollowedAsFromScratch(const MultiTriangulation& mt) {
  std::mt19937_64 random(23);
  const Extent extent(mt);
  IncrementalCut cut(mt);
  View view;
  view.eye = {extent.low.x + 0.2 * extent.size(), extent.low.y + 0.2 * extent.size(),
              extent.high.z + 0.1 * extent.relief()};
  view.forward = {1, 1, -0.2};
  for (int move = 0; move < 25; ++move) {
    std::normal_distribution<double> step(0, 0.01);
    view.eye.x += step(random) * extent.size(), view.eye.y += step(random) * extent.size();
    view.forward.x += step(random), view.forward.y += step(random);
    const ViewError criterion({.view = view, .pixels = 2}, mt.arrays().metric);
    CutOptions scratch{.method = CutMethod::saturated};
    IncrementalOptions options;
    if (move % 5 == 4) scratch.maxTriangles = options.maxTriangles = mt.rootTriangleCount() + 20'000;
    ASSERT_TRUE(cut.update(criterion, options));
    EXPECT_EQ(cut.nodes(), takeNodes(mt, criterion, scratch)->nodes);
  }
  EXPECT_TRUE(cut.validate());
}

TEST_P(RealCriteria, AreMetWithinBudgetAndDeadlineAndFollowedByAnIncrementalCut) {
  expectCriteriaMet(mt());
  expectOrdersWithinBudgetAndDeadline(mt());
  expectFollowedAsFromScratch(mt());
}

INSTANTIATE_TEST_SUITE_P(Dems, RealCriteria,
                         testing::Values("dem/srtm1_bigtujunga_utm11.tif",
                                         "dem/srtm3_N46E008_bernese_alps.tif",
                                         "dem/lidar2m_maungawhau_nztm.tif"),
                         [](const auto& made) {
                           std::string name = std::filesystem::path(made.param).stem().string();
                           std::ranges::replace_if(
                               name, [](char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

}  // namespace
}  // namespace arete
