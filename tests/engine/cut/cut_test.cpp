// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuts against an oracle: the least closed set by plain iteration to a fixed point over all triangles, and
// the front by applying modifications one by one to a set of triangles.
#include "engine/cut/cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <string_view>
#include <vector>

#include "engine/cut_promises.h"
#include "engine/family_models.h"
#include "engine/laws/validate.h"

namespace arete {
namespace {

double spanOfErrors(const MultiTriangulation& mt) {
  return mt.nodeCount() ? mt.largestError() : 1;
}

/// Of a raster family, so large that its nodes fill many pages.
TerrainModel modelOfManyPages(std::string_view name, HoleShape shape) {
  const auto family = std::ranges::find(rasterFamilies(), name,
                                        [](const RasterFamily& f) { return std::string_view(f.name); });
  return build(family->make(130, 120, 9), {.shape = shape}).value();
}

TEST(MinimalCut, IsTheLeastClosedSetForUniformErrors) {
  for (const FamilyModel& s : familyModels())
    for (const double part : {0.0, 0.001, 0.02, 0.1, 0.4, 1.0}) {
      const UniformError criterion(part * spanOfErrors(s.model.mt));
      const auto nodes = takeNodes(s.model.mt, criterion);
      ASSERT_TRUE(nodes);
      EXPECT_EQ(nodes->nodes, leastClosedSet(s.model.mt, criterion)) << s.name << " " << part;
    }
}

TEST(MinimalCut, IsTheLeastClosedSetForRegions) {
  for (const FamilyModel& s : familyModels()) {
    const Region region({{{5.5, 4}, {17, 6.25}, {12, 19}, {3, 12}}});
    const double span = spanOfErrors(s.model.mt);
    const RegionError criterion(region, s.model.mt.arrays().metric, 0.01 * span, 0.3 * span);
    const auto nodes = takeNodes(s.model.mt, criterion);
    ASSERT_TRUE(nodes);
    EXPECT_EQ(nodes->nodes, leastClosedSet(s.model.mt, criterion)) << s.name;
  }
}

TEST(MinimalCut, IsTheLeastClosedSetForEveryCriterion) {
  std::mt19937_64 random(5);
  for (const FamilyModel& s : familyModels())
    for (const auto& [name, criterion] : criteriaFor(s.model.mt, random)) {
      const auto nodes = takeNodes(s.model.mt, *criterion);
      ASSERT_TRUE(nodes);
      EXPECT_EQ(nodes->nodes, leastClosedSet(s.model.mt, *criterion)) << s.name << " " << name;
    }
}

TEST(SaturatedCut, IsClosedForEveryCriterionThatItTakes) {
  std::mt19937_64 random(6);
  for (const FamilyModel& s : familyModels())
    for (int round = 0; round < 5; ++round)
      for (const auto& [name, criterion] : criteriaFor(s.model.mt, random)) {
        if (!criterion->isMonotone()) continue;
        const auto cut = takeNodes(s.model.mt, *criterion, {.method = CutMethod::saturated});
        ASSERT_TRUE(cut);
        NodeSet closed = cut->nodes;
        closeUpwards(s.model.mt, closed);
        EXPECT_EQ(closed, cut->nodes) << s.name << " " << name;
      }
}

TEST(Cuts, KeepWhatEveryCriterionAsks) {
  std::mt19937_64 random(7);
  for (const FamilyModel& s : familyModels())
    for (const auto& [name, criterion] : criteriaFor(s.model.mt, random)) {
      SCOPED_TRACE(s.name + " " + name);
      expectCutsKept(s.model.mt, *criterion);
    }
}

TEST(MinimalCut, IsTheLeastClosedSetOfModelsOfManyPages) {
  for (const char* name : {"noise", "fractal", "nodata holes", "integer"})
    for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
      const TerrainModel model = modelOfManyPages(name, shape);
      const MultiTriangulation& mt = model.mt;
      for (const double part : {0.0, 0.003, 0.05, 0.2, 0.5, 0.8}) {
        const UniformError uniform(part * spanOfErrors(mt));
        EXPECT_EQ(takeNodes(mt, uniform)->nodes, leastClosedSet(mt, uniform)) << name << " " << part;
        const RegionError corner(Region::box({20, 20, 60, 50}), mt.arrays().metric, part * spanOfErrors(mt),
                                 2 * part * spanOfErrors(mt));
        EXPECT_EQ(takeNodes(mt, corner)->nodes, leastClosedSet(mt, corner)) << name << " " << part;
      }
    }
}

/// Errors as nobody's build makes them, saturated errors smaller than those below them: as a file might hold.
TEST(MinimalCut, IsTheLeastClosedSetWhereSaturatedErrorsAreNone) {
  std::mt19937_64 random(31);
  for (const FamilyModel& s : familyModels()) {
    MtArrays arrays = s.model.mt.arrays();
    std::vector<OutwardScale::Code> error(arrays.error.begin(), arrays.error.end());
    for (OutwardScale::Code& code : error)
      if (random() % 8 == 0) code = static_cast<OutwardScale::Code>(random());
    arrays.error = error;
    const MultiTriangulation mt(arrays, nullptr);
    for (const double part : {0.0, 0.01, 0.1, 0.4, 1.0}) {
      const UniformError uniform(part * spanOfErrors(mt));
      EXPECT_EQ(takeNodes(mt, uniform)->nodes, leastClosedSet(mt, uniform)) << s.name << " " << part;
    }
  }
}

/// Saturated errors as nobody's build makes them, of a parent smaller than of its child, though the bands are
/// in order.
TEST(MinimalCut, IsTheLeastClosedSetWhereSaturatedErrorsAreOfTheBandAlone) {
  std::mt19937_64 random(33);
  for (const char* name : {"noise", "fractal", "integer"}) {
    const TerrainModel model = modelOfManyPages(name, HoleShape::delaunay);
    MtArrays arrays = model.mt.arrays();
    std::vector<OutwardScale::Code> saturated(arrays.saturatedError.begin(), arrays.saturatedError.end());
    constexpr std::uint32_t kOfBand = (1u << MultiTriangulation::kBandShift) - 1;
    for (OutwardScale::Code& code : saturated)
      code = static_cast<OutwardScale::Code>((code & ~kOfBand) | (random() & kOfBand));
    arrays.saturatedError = saturated;
    const MultiTriangulation mt(arrays, nullptr);
    for (int round = 0; round < 20; ++round) {
      const UniformError uniform(arrays.scale.decode(saturated[random() % mt.nodeCount()]));
      EXPECT_EQ(takeNodes(mt, uniform)->nodes, leastClosedSet(mt, uniform)) << name << " " << round;
    }
  }
}

/// Parents that only a child asks for, of smaller saturated errors than it: a cut lacks some, and its front
/// is whole all the same.
TEST(MinimalCut, HasAWholeFrontWhereParentsAreSaidToErrLess) {
  int lacking = 0;
  for (const char* name : {"noise", "fractal", "integer"}) {
    const TerrainModel model = modelOfManyPages(name, HoleShape::delaunay);
    MtArrays arrays = model.mt.arrays();
    for (const double part : {0.003, 0.05, 0.2}) {
      const UniformError uniform(part * spanOfErrors(model.mt));
      const OutwardScale::Code code = arrays.scale.floorCode(uniform.uniformError());
      const std::uint32_t band = MultiTriangulation::bandOf(code);
      std::vector<OutwardScale::Code> saturated(model.mt.arrays().saturatedError.begin(),
                                                model.mt.arrays().saturatedError.end());
      for (std::uint32_t n = model.mt.bandBegin(band); n < model.mt.bandEnd(band); ++n)
        if (std::ranges::none_of(model.mt.floor(NodeId(n)),
                                 [&](std::uint32_t t) { return arrays.error[t] > code; }))
          saturated[n] = static_cast<OutwardScale::Code>(band << MultiTriangulation::kBandShift);
      arrays.saturatedError = saturated;
      const MultiTriangulation mt(arrays, nullptr);
      const auto cut = takeCut(mt, uniform);
      ASSERT_TRUE(cut);
      EXPECT_TRUE(validateFront(mt, *cut, domainExtent(mt))) << name << " " << part;
      lacking += takeNodes(mt, uniform)->nodes != leastClosedSet(mt, uniform) ? 1 : 0;
    }
  }
  EXPECT_GT(lacking, 0);
}

/// Spheres as nobody's build makes them, which hold nothing: what a saturated cut finds by them lacks
/// parents, and its front is whole all the same.
TEST(SaturatedCut, HasAWholeFrontWhereSpheresHoldNobody) {
  std::mt19937_64 random(32);
  int unlike = 0;
  for (const FamilyModel& s : familyModels()) {
    MtArrays arrays = s.model.mt.arrays();
    std::vector<Sphere> sphere(arrays.sphere.begin(), arrays.sphere.end());
    for (Sphere& ball : sphere)
      if (random() % 2 == 0) ball.radius = 0;
    arrays.sphere = sphere;
    const MultiTriangulation mt(arrays, nullptr);
    const double span = spanOfErrors(mt);
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

TEST(MinimalCut, TakesAnyPredicateAndSaturatedRefusesIt) {
  struct Odd final : Criterion {
    bool isFineEnough(const MultiTriangulation&, TriangleId t,
                      const std::array<std::uint32_t, 3>&) const override {
      return t.index() % 3 != 0;
    }
  };
  for (const FamilyModel& s : familyModels()) {
    const auto nodes = takeNodes(s.model.mt, Odd{});
    ASSERT_TRUE(nodes);
    EXPECT_EQ(nodes->nodes, leastClosedSet(s.model.mt, Odd{})) << s.name;
    const auto refused = takeCut(s.model.mt, Odd{}, {.method = CutMethod::saturated});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::usage);
  }
}

TEST(SaturatedCut, IsEveryNodeWhoseErrorExceedsWhatItsSphereAllows) {
  std::mt19937_64 random(8);
  for (const FamilyModel& s : familyModels())
    for (int round = 0; round < 5; ++round)
      for (const auto& [name, criterion] : criteriaFor(s.model.mt, random)) {
        if (!criterion->isMonotone()) continue;
        const MultiTriangulation& mt = s.model.mt;
        NodeSet expected(mt.nodeCount(), 0);
        std::uint32_t triangles = mt.rootTriangleCount();
        for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) {
          if (mt.saturatedError(NodeId(n)) <= criterion->allowedError(mt.arrays().sphere[n])) continue;
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
        if (std::isnan(criterion->uniformError())) continue;
        EXPECT_EQ(uniformTriangleCount(mt, criterion->uniformError()), triangles);
      }
}

TEST(SaturatedCut, UnderABudgetIsTheWorstNodesThatFit) {
  for (const FamilyModel& s : familyModels()) {
    const MultiTriangulation& mt = s.model.mt;
    std::vector<std::uint32_t> order(mt.nodeCount());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) {
      return mt.arrays().saturatedError[a] > mt.arrays().saturatedError[b];
    });
    const std::uint32_t roots = mt.rootTriangleCount(), finest = mt.finestTriangleCount();
    for (const double part : {0.0, 0.03, 0.2, 0.71, 1.0})
      for (const double allowed : {0.0, 0.02 * spanOfErrors(mt)}) {
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

TEST(SaturatedCut, HoldsTheMinimalOneAndMeetsTheSameBound) {
  for (const FamilyModel& s : familyModels())
    for (const double part : {0.0, 0.005, 0.05, 0.3, 1.0}) {
      const double bound = part * spanOfErrors(s.model.mt);
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
    const double span = spanOfErrors(s.model.mt);
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

TEST(Fronts, AreWhatApplyingTheModificationsOneByOneGives) {
  std::mt19937_64 random(99);
  for (const FamilyModel& s : familyModels()) {
    const MultiTriangulation& mt = s.model.mt;
    NodeSet set(mt.nodeCount(), 0);
    for (std::uint32_t i = 0; i < mt.nodeCount() / 20 + 1 && mt.nodeCount() > 0; ++i)
      set[random() % mt.nodeCount()] = 1;
    closeUpwards(mt, set);
    std::set<std::uint32_t> current;
    for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t) current.insert(t);
    for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) {
      if (!set[n]) continue;
      for (const std::uint32_t t : mt.floor(NodeId(n))) ASSERT_EQ(current.erase(t), 1u) << s.name;
      for (std::uint32_t i = 0; i < mt.ceilingSize(NodeId(n)); ++i)
        current.insert(mt.slotTriangle(NodeId(n), i).index());
    }
    const Cut cut = front(mt, set);
    EXPECT_EQ(std::set<std::uint32_t>(cut.ids.begin(), cut.ids.end()), current) << s.name;
    for (std::size_t t = 0; t < cut.ids.size(); ++t) {
      std::array<std::uint32_t, 3> corners;
      for (int i = 0; i < 3; ++i) corners[i] = cut.vertices[cut.triangles[t][i]];
      EXPECT_EQ(corners, mt.corners(TriangleId(cut.ids[t]))) << s.name;
    }
  }
}

TEST(Fronts, OfAPrefixAreThoseOfTheSameSet) {
  for (const FamilyModel& s : familyModels()) {
    const std::uint32_t n = s.model.mt.nodeCount() / 2;
    NodeSet set(s.model.mt.nodeCount(), 0);
    std::fill(set.begin(), set.begin() + n, std::uint8_t(1));
    const Cut a = frontOfPrefix(s.model.mt, n), b = front(s.model.mt, set);
    EXPECT_EQ(a.ids, b.ids);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.triangles.size(), s.model.mt.prefixTriangleCount(n));
  }
}

TEST(Budget, IsNeverExceededAndNearlySpent) {
  for (const FamilyModel& s : familyModels()) {
    const MultiTriangulation& mt = s.model.mt;
    const std::uint32_t roots = mt.rootTriangleCount(), finest = mt.finestTriangleCount();
    for (const double part : {0.0, 0.05, 0.3, 0.8, 1.0})
      for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
        const auto budget = static_cast<std::uint32_t>(roots + part * (finest - roots));
        const auto cut = takeCut(mt, UniformError(0), {.method = method, .maxTriangles = budget});
        ASSERT_TRUE(cut) << s.name;
        EXPECT_LE(cut->triangles.size(), budget) << s.name;
        EXPECT_TRUE(validateFront(mt, *cut, domainExtent(mt))) << s.name;
        // Of the uniform cuts of at most that size in the same MT, none is more than 10 % better.
        for (double e = cut->achievedError * 0.89; e > 0; e *= 0.5) {
          const auto better = takeCut(mt, UniformError(e), {.method = method});
          EXPECT_GT(better->triangles.size(), budget) << s.name << " budget " << budget << " error " << e;
        }
      }
  }
}

/// The walk from the root, worst first, is what a budget means; where a criterion does not say that its error
/// is the same everywhere there is nothing else.
TEST(Budget, OfAUniformErrorIsWhatTheWalkFromTheRootComesTo) {
  struct Silent final : Criterion {
    double maxError = 0;
    bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners&) const override {
      return mt.error(t) <= maxError;
    }
  };
  for (const FamilyModel& s : familyModels()) {
    const MultiTriangulation& mt = s.model.mt;
    const std::uint32_t roots = mt.rootTriangleCount(), finest = mt.finestTriangleCount();
    for (const double maxError : {0.0, 0.02 * spanOfErrors(mt)})
      for (int i = 0; i <= 40; ++i) {
        const std::uint32_t budget = roots + (finest - roots) * static_cast<std::uint32_t>(i) / 40;
        Silent silent;
        silent.maxError = maxError;
        const auto fast = takeNodes(mt, UniformError(maxError), {.maxTriangles = budget}),
                   walk = takeNodes(mt, silent, {.maxTriangles = budget});
        ASSERT_TRUE(fast && walk);
        EXPECT_EQ(fast->nodes, walk->nodes) << s.name << " " << budget;
        EXPECT_EQ(fast->isComplete, walk->isComplete) << s.name << " " << budget;
      }
  }
}

TEST(Budget, BelowTheRootIsRefusedWithTheCount) {
  const FamilyModel& s = familyModels().front();
  for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
    const auto cut = takeCut(s.model.mt, UniformError(0),
                             {.method = method, .maxTriangles = s.model.mt.rootTriangleCount() - 1});
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().code, ErrorCode::usage);
    EXPECT_NE(cut.error().message.find(std::to_string(s.model.mt.rootTriangleCount())), std::string::npos);
  }
}

TEST(Cuts, StopWhenAskedTo) {
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
    const auto cut = takeCut(familyModels().front().model.mt, UniformError(0), {.method = method}, context);
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().code, ErrorCode::interrupted);
  }
}

}  // namespace
}  // namespace arete
