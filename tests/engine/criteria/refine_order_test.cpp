// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/criteria/refine_order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/cut_promises.h"
#include "engine/family_models.h"

namespace arete {
namespace {

struct NamedOrder {
  std::string name;
  std::shared_ptr<const RefineOrder> order;
};

std::vector<NamedOrder> ordersFor(const MultiTriangulation& mt, std::mt19937_64& random) {
  TwoQueues::Options options;
  options.view = randomView(Extent(mt), random);
  return {{"worst first", std::make_shared<WorstFirst>()},
          {"breadth first", std::make_shared<BreadthFirst>()},
          {"depth first", std::make_shared<DepthFirst>()},
          {"two queues", std::make_shared<TwoQueues>(options)}};
}

TEST(RefineOrders, AllReachTheLeastCutWhenNothingEndsThem) {
  std::mt19937_64 random(1);
  for (const FamilyModel& m : familyModels())
    for (const auto& [name, criterion] : criteriaFor(m.model.mt, random)) {
      const auto least = takeNodes(m.model.mt, *criterion);
      for (const auto& [orderName, order] : ordersFor(m.model.mt, random)) {
        const auto cut =
            takeNodes(m.model.mt, *criterion,
                      {.maxTriangles = std::numeric_limits<std::uint32_t>::max(), .order = order});
        ASSERT_TRUE(cut);
        EXPECT_EQ(cut->nodes, least->nodes) << m.name << " " << name << " " << orderName;
        EXPECT_TRUE(cut->isComplete);
      }
    }
}

TEST(RefineOrders, NeverExceedABudgetAndAlwaysConform) {
  std::mt19937_64 random(2);
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    const DomainExtent domain = domainExtent(mt);
    const std::uint32_t roots = mt.rootTriangleCount(), finest = mt.finestTriangleCount();
    for (const auto& [name, criterion] : criteriaFor(mt, random))
      for (const auto& [orderName, order] : ordersFor(mt, random)) {
        const auto budget = roots + static_cast<std::uint32_t>(random() % (finest - roots + 1));
        const auto cut = takeCut(mt, *criterion, {.maxTriangles = budget, .order = order});
        ASSERT_TRUE(cut);
        EXPECT_LE(cut->triangles.size(), budget) << m.name << " " << name << " " << orderName;
        EXPECT_TRUE(validateFront(mt, *cut, domain)) << m.name << " " << name << " " << orderName;
        if (cut->isComplete) expectMet(mt, *criterion, *cut);
      }
  }
}

TEST(RefineOrders, StopWithinOneModificationOfTheDeadline) {
  std::mt19937_64 random(3);
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    const DomainExtent domain = domainExtent(mt);
    for (const auto& [name, order] : ordersFor(mt, random))
      for (const int looks : {0, 1, 7, 60}) {
        const auto cut = takeCut(mt, UniformError(0), {.deadline = strikeAfter(looks), .order = order});
        ASSERT_TRUE(cut);
        EXPECT_LE(cut->nodes, std::uint32_t(looks)) << m.name << " " << name;
        EXPECT_EQ(cut->isComplete, cut->nodes == takeCut(mt, UniformError(0))->nodes)
            << m.name << " " << name;
        EXPECT_TRUE(validateFront(mt, *cut, domain)) << m.name << " " << name;
        if (name != "worst first") {
          EXPECT_EQ(cut->nodes, std::min(std::uint32_t(looks), takeCut(mt, UniformError(0))->nodes));
        }
      }
  }
}

TEST(WorstFirst, LeavesUnderABudgetWhatNoUniformCutOfThatSizeBetters) {
  std::mt19937_64 random(4);
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    const View view = randomView(Extent(mt), random);
    const auto inView = [&](double pixels) {
      return ViewError({.view = view, .pixels = pixels}, mt.arrays().metric);
    };
    const ViewError finest = inView(1e-3);
    const std::uint32_t roots = mt.rootTriangleCount();
    const auto whole = static_cast<std::uint32_t>(takeCut(mt, finest)->triangles.size());
    for (const double part : {0.1, 0.5}) {
      const auto budget = roots + static_cast<std::uint32_t>(part * (whole - roots));
      const auto cut = takeCut(mt, finest, {.maxTriangles = budget});
      ASSERT_TRUE(cut);
      const double pixels = worstSeverity(mt, finest, *cut);
      if (!std::isfinite(pixels)) continue;  // around the eye no budget is enough
      for (double p = pixels * 0.89; p > 1e-3; p *= 0.5)
        EXPECT_GT(takeCut(mt, inView(p))->triangles.size(), budget) << m.name << " " << pixels << " " << p;
    }
  }
}

TEST(BreadthFirst, RefinesTheWholeFrontBeforeAnyOfItTwice) {
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    std::uint32_t wanted = 0;
    for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t)
      wanted += mt.remover(TriangleId(t)).isValid() && mt.error(TriangleId(t)) > 0 ? 1 : 0;
    if (wanted == 0) continue;
    // As many modifications as it takes at most: each removes a root triangle, or is an ancestor of one that
    // does.
    const auto breadth =
        takeNodes(mt, UniformError(0),
                  {.deadline = strikeAfter(int(wanted)), .order = std::make_shared<BreadthFirst>()});
    const auto depth = takeNodes(
        mt, UniformError(0), {.deadline = strikeAfter(int(wanted)), .order = std::make_shared<DepthFirst>()});
    const auto rootsLeft = [&](const NodeSet& set) {
      std::uint32_t left = 0;
      for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t)
        left += mt.remover(TriangleId(t)).isValid() && mt.error(TriangleId(t)) > 0 &&
                        !set[mt.remover(TriangleId(t)).index()]
                    ? 1
                    : 0;
      return left;
    };
    EXPECT_LE(rootsLeft(breadth->nodes), rootsLeft(depth->nodes)) << m.name;
  }
}

TEST(TwoQueues, RefineTheGroundUnderALowCameraThatSeesNoVertex) {
  std::size_t tried = 0;
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    const MetricFrame& metric = mt.arrays().metric;
    // Just over the middle of the largest root triangle, looking straight down through a keyhole.
    for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t) {
      if (!mt.remover(TriangleId(t)).isValid() || mt.error(TriangleId(t)) == 0) continue;
      const auto corners = mt.corners(TriangleId(t));
      Vec3 middle;
      for (const std::uint32_t c : corners) {
        const Vec3 p = metric.toMetric(mt.position(VertexId(c)));
        middle = {middle.x + p.x / 3, middle.y + p.y / 3, middle.z + p.z / 3};
      }
      TwoQueues::Options options;
      options.view.eye = {middle.x, middle.y, middle.z + 0.01 * Extent(mt).size()};
      options.view.forward = {0, 0, -1};
      options.view.up = {1, 0, 0};
      options.view.verticalFieldOfView = 0.02;
      const auto cut = takeNodes(
          mt, UniformError(0), {.deadline = strikeAfter(200), .order = std::make_shared<TwoQueues>(options)});
      ASSERT_TRUE(cut);
      EXPECT_TRUE(cut->nodes[mt.remover(TriangleId(t)).index()]) << m.name << " triangle " << t;
      ++tried;
    }
  }
  EXPECT_GT(tried, 20u);
}

TEST(Deadlines, AreRefusedForASaturatedCut) {
  const auto cut = takeCut(familyModels().front().model.mt, UniformError(1),
                           {.method = CutMethod::saturated, .deadline = strikeAfter(3)});
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace arete
