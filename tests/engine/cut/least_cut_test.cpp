// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle is the least closed set by plain iteration to a fixed point over all triangles.
#include "engine/cut/least_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string_view>
#include <vector>

#include "engine/cut/front.h"
#include "engine/cut_promises.h"
#include "engine/family_models.h"

namespace arete {
namespace {

double spanOfErrors(const MultiTriangulation& mt) {
  return mt.nodeCount() ? mt.largestError() : 1;
}

/// Of a raster family, so large that its nodes fill many cluster groups.
TerrainModel largeModel(std::string_view name, HoleShape shape) {
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

TEST(MinimalCut, IsTheLeastClosedSetOfLargeModels) {
  for (const char* name : {"noise", "fractal", "nodata holes", "integer"})
    for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
      const TerrainModel model = largeModel(name, shape);
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

/// Errors that no build makes but a file may hold: saturated errors smaller than those of their descendants.
TEST(MinimalCut, IsTheLeastClosedSetWhereSaturatedErrorsAreTooSmall) {
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

/// Saturated errors that no build makes but a file may hold: a parent's may be smaller than its child's,
/// although the bands are in order.
TEST(MinimalCut, IsTheLeastClosedSetWhereSaturatedErrorsAreRightOnlyInTheirBand) {
  std::mt19937_64 random(33);
  for (const char* name : {"noise", "fractal", "integer"}) {
    const TerrainModel model = largeModel(name, HoleShape::delaunay);
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

/// Parents that only a child needs, with smaller saturated errors than the child: the cut lacks some, and its
/// front is conforming all the same.
TEST(MinimalCut, HasAConformingFrontWhereParentsHaveSmallerErrors) {
  int lacking = 0;
  for (const char* name : {"noise", "fractal", "integer"}) {
    const TerrainModel model = largeModel(name, HoleShape::delaunay);
    MtArrays arrays = model.mt.arrays();
    for (const double part : {0.003, 0.05, 0.2}) {
      const UniformError uniform(part * spanOfErrors(model.mt));
      const OutwardScale::Code code = arrays.scale.floorCode(*uniform.uniformError());
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

TEST(LeastMembersWithin, IsTheLeastSetOfTheSmallestErrorThatTheBudgetAllows) {
  const auto never = [] { return false; };
  for (const FamilyModel& s : familyModels()) {
    const MultiTriangulation& mt = s.model.mt;
    const std::uint32_t roots = mt.rootTriangleCount(), finest = mt.finestTriangleCount();
    for (const double part : {0.0, 0.1, 0.35, 0.9, 1.0}) {
      const auto budget = static_cast<std::uint32_t>(roots + part * (finest - roots));
      const auto found = leastMembersWithin(mt, 0, budget, never);
      ASSERT_TRUE(found);
      // By trying every code in turn.
      NodeSet expected(mt.nodeCount(), 0);
      for (std::uint32_t code = 0; code <= OutwardScale::kMaxCode; code += 1) {
        const UniformError uniform(mt.arrays().scale.decode(static_cast<OutwardScale::Code>(code)));
        const auto set = leastMembers(mt, uniform, never);
        if (frontSize(mt, *set) > budget) {
          // The next code that any triangle has.
          std::uint32_t next = OutwardScale::kMaxCode;
          for (const OutwardScale::Code c : mt.arrays().error)
            if (c > code) next = std::min<std::uint32_t>(next, c);
          if (next == OutwardScale::kMaxCode) break;
          code = next - 1;
          continue;
        }
        expected = set->toNodeSet(mt.nodeCount());
        break;
      }
      EXPECT_EQ(found->toNodeSet(mt.nodeCount()), expected) << s.name << " " << part;
    }
  }
}

TEST(LeastMembers, ReturnNothingWhenStopped) {
  for (const FamilyModel& s : familyModels()) {
    const MultiTriangulation& mt = s.model.mt;
    if (leastMembers(mt, UniformError(0), [] { return false; })->size() == 0) continue;
    EXPECT_FALSE(leastMembers(mt, UniformError(0), [] { return true; })) << s.name;
    EXPECT_FALSE(leastMembersByWalk(mt, UniformError(0), [] { return true; })) << s.name;
  }
}

}  // namespace
}  // namespace arete
