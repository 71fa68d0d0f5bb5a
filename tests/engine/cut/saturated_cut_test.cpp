// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracles test each node by itself, and sort all of them.
#include "engine/cut/saturated_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

#include "engine/cut_promises.h"
#include "engine/family_models.h"
#include "engine/laws/validate.h"

namespace arete {
namespace {

double spanOfSaturated(const MultiTriangulation& mt) {
  return mt.nodeCount() ? mt.largestError() : 1;
}

TEST(SaturatedCut, IsClosedForEveryCriterionThatItTakes) {
  std::mt19937_64 random(6);
  for (const FamilyModel& s : familyModels())
    for (int round = 0; round < 5; ++round)
      for (const auto& [name, criterion] : criteriaFor(s.model.mt, random)) {
        if (criterion->bounded() == nullptr) continue;
        const auto cut = takeNodes(s.model.mt, *criterion, {.method = CutMethod::saturated});
        ASSERT_TRUE(cut);
        NodeSet closed = cut->nodes;
        closeUpwards(s.model.mt, closed);
        EXPECT_EQ(closed, cut->nodes) << s.name << " " << name;
      }
}

/// Spheres that no build makes but a file may hold, of radius 0: the saturated cut lacks parents, and its
/// front is conforming all the same.
TEST(SaturatedCut, HasAConformingFrontWhereSpheresAreTooSmall) {
  std::mt19937_64 random(32);
  int unlike = 0;
  for (const FamilyModel& s : familyModels()) {
    MtArrays arrays = s.model.mt.arrays();
    std::vector<Sphere> sphere(arrays.sphere.begin(), arrays.sphere.end());
    for (Sphere& ball : sphere)
      if (random() % 2 == 0) ball.radius = 0;
    arrays.sphere = sphere;
    const MultiTriangulation mt(arrays, nullptr);
    const double span = spanOfSaturated(mt);
    for (const double part : {0.0, 0.01, 0.1}) {
      const RegionError corner(Region::box({3, 3, 9, 8}), arrays.metric, part * span, 4 * part * span + 0.1);
      const auto cut = takeCut(mt, corner, {.method = CutMethod::saturated}),
                 before = takeCut(s.model.mt, corner, {.method = CutMethod::saturated});
      ASSERT_TRUE(cut && before);
      EXPECT_TRUE(validateFront(mt, *cut, domainExtent(mt))) << s.name << " " << part;
      unlike += cut->nodes != before->nodes ? 1 : 0;
    }
  }
  EXPECT_GT(unlike, 10);
}

TEST(SaturatedCut, IsEveryNodeWhoseErrorExceedsWhatItsSphereAllows) {
  std::mt19937_64 random(8);
  for (const FamilyModel& s : familyModels())
    for (int round = 0; round < 5; ++round)
      for (const auto& [name, criterion] : criteriaFor(s.model.mt, random)) {
        if (criterion->bounded() == nullptr) continue;
        const MultiTriangulation& mt = s.model.mt;
        NodeSet expected(mt.nodeCount(), 0);
        std::uint32_t triangles = mt.rootTriangleCount();
        for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) {
          if (mt.saturatedError(NodeId(n)) <= criterion->bounded()->allowedError(mt.arrays().sphere[n]))
            continue;
          expected[n] = 1;
          triangles += mt.isOpen(NodeId(n)) ? 1 : 2;
        }
        SCOPED_TRACE(s.name + " " + name);
        const auto nodes = takeNodes(mt, *criterion, {.method = CutMethod::saturated});
        ASSERT_TRUE(nodes);
        EXPECT_EQ(nodes->nodes, expected);
        const auto cut = takeCut(mt, *criterion, {.method = CutMethod::saturated});
        ASSERT_TRUE(cut);
        EXPECT_EQ(cut->ids, front(mt, expected).ids);
        EXPECT_EQ(cut->triangles.size(), triangles);
        if (const auto uniform = criterion->bounded()->uniformError()) {
          EXPECT_EQ(uniformTriangleCount(mt, *uniform), triangles);
        }
      }
}

/// How many ancestors of the same saturated error the longest chain above each node has.
std::vector<std::uint32_t> generationsOf(const MultiTriangulation& mt) {
  std::vector<std::uint32_t> generation(mt.nodeCount(), 0);
  for (std::uint32_t n = 0; n < mt.nodeCount(); ++n)
    for (const std::uint32_t t : mt.floor(NodeId(n)))
      if (const NodeId parent = mt.creator(TriangleId(t));
          parent.isValid() && mt.saturatedError(parent) == mt.saturatedError(NodeId(n)))
        generation[n] = std::max(generation[n], generation[parent.index()] + 1);
  return generation;
}

TEST(SaturatedCut, UnderABudgetIsTheWorstNodesThatFit) {
  for (const FamilyModel& s : familyModels()) {
    const MultiTriangulation& mt = s.model.mt;
    std::vector<std::uint32_t> order(mt.nodeCount());
    std::iota(order.begin(), order.end(), 0u);
    const std::vector<std::uint32_t> generation = generationsOf(mt);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t n) {
      const Vec3 place = mt.position(mt.apex(NodeId(n)));
      return std::tuple(-mt.saturatedError(NodeId(n)), generation[n], place.x, place.y, place.z);
    });
    const std::uint32_t roots = mt.rootTriangleCount(), finest = mt.finestTriangleCount();
    for (const double part : {0.0, 0.03, 0.2, 0.71, 1.0})
      for (const double allowed : {0.0, 0.02 * spanOfSaturated(mt)}) {
        const auto budget = static_cast<std::uint32_t>(roots + part * (finest - roots));
        NodeSet expected(mt.nodeCount(), 0);
        std::uint32_t triangles = roots;
        bool fits = true;
        for (const std::uint32_t n : order) {
          if (mt.saturatedError(NodeId(n)) <= allowed) break;
          triangles += mt.isOpen(NodeId(n)) ? 1 : 2;
          fits = fits && triangles <= budget;
          if (fits) expected[n] = 1;
        }
        const auto nodes =
            takeNodes(mt, UniformError(allowed), {.method = CutMethod::saturated, .maxTriangles = budget});
        ASSERT_TRUE(nodes) << s.name;
        EXPECT_EQ(nodes->nodes, expected) << s.name << " " << part << " " << allowed;
        EXPECT_EQ(nodes->isComplete, fits) << s.name;
      }
  }
}

TEST(SaturatedCut, ContainsTheMinimalOneAndMeetsTheSameBound) {
  for (const FamilyModel& s : familyModels())
    for (const double part : {0.0, 0.005, 0.05, 0.3, 1.0}) {
      const double bound = part * spanOfSaturated(s.model.mt);
      const auto minimal = takeCut(s.model.mt, UniformError(bound));
      const auto saturated = takeCut(s.model.mt, UniformError(bound), {.method = CutMethod::saturated});
      ASSERT_TRUE(minimal && saturated);
      EXPECT_LE(minimal->triangles.size(), saturated->triangles.size()) << s.name;
      EXPECT_LE(minimal->achievedError, bound) << s.name;
      EXPECT_LE(saturated->achievedError, bound) << s.name;
    }
}

TEST(SaturatedCut, IsClosedForRegionsToo) {
  for (const FamilyModel& s : familyModels()) {
    const double span = spanOfSaturated(s.model.mt);
    const RegionError criterion(Region::box({4, 6, 13, 15}), s.model.mt.arrays().metric, 0.005 * span,
                                0.5 * span);
    auto nodes = takeNodes(s.model.mt, criterion, {.method = CutMethod::saturated});
    ASSERT_TRUE(nodes);
    NodeSet closed = nodes->nodes;
    closeUpwards(s.model.mt, closed);
    EXPECT_EQ(closed, nodes->nodes) << s.name;
    const Cut cut = front(s.model.mt, nodes->nodes);
    for (std::size_t t = 0; t < cut.ids.size(); ++t)
      EXPECT_TRUE(criterion.isFineEnough(s.model.mt, TriangleId(cut.ids[t]),
                                         s.model.mt.corners(TriangleId(cut.ids[t]))))
          << s.name;
  }
}

TEST(SaturatedCut, UnderABudgetTakesTheLargestRatiosOfErrorToAllowedErrorFirst) {
  std::mt19937_64 random(41);
  for (const FamilyModel& s : familyModels())
    for (const auto& [name, criterion] : criteriaFor(s.model.mt, random)) {
      const BoundedCriterion* const bounded = criterion->bounded();
      if (bounded == nullptr) continue;
      const MultiTriangulation& mt = s.model.mt;
      SCOPED_TRACE(s.name + " " + name);
      const auto ratio = [&](std::uint32_t n) {
        const double allowed = bounded->allowedError(mt.arrays().sphere[n]);
        return allowed > 0 ? mt.saturatedError(NodeId(n)) / allowed : std::numeric_limits<double>::infinity();
      };
      const NodeSet all = saturatedMembers(mt, *bounded, {}).members.toNodeSet(mt.nodeCount());
      const auto needed = static_cast<std::uint32_t>(front(mt, all).ids.size());
      for (const double part : {0.0, 0.3, 0.7, 1.0}) {
        const auto budget =
            mt.rootTriangleCount() + static_cast<std::uint32_t>(part * (needed - mt.rootTriangleCount()));
        const SaturatedMembers cut = saturatedMembers(mt, *bounded, budget);
        const NodeSet kept = cut.members.toNodeSet(mt.nodeCount());
        EXPECT_EQ(cut.isComplete, kept == all);
        EXPECT_LE(front(mt, kept).ids.size(), budget);
        double leastKept = std::numeric_limits<double>::infinity(), mostLeft = 0;
        for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) {
          EXPECT_LE(kept[n], all[n]);
          if (kept[n]) leastKept = std::min(leastKept, ratio(n));
          if (all[n] && !kept[n]) mostLeft = std::max(mostLeft, ratio(n));
        }
        EXPECT_GE(leastKept, mostLeft);
        NodeSet closed = kept;
        closeUpwards(mt, closed);
        EXPECT_EQ(closed, kept);
      }
    }
}

}  // namespace
}  // namespace arete
