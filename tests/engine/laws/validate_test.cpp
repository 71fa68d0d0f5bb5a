// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/laws/validate.h"

#include <gtest/gtest.h>

#include "datasets/families.h"
#include "engine/copied_mt.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

MultiTriangulation sample() {
  static const Result<TerrainModel> model = [] {
    for (const RasterFamily& family : rasterFamilies())
      if (family.name == "fractal") return build(family.make(33, 27, 5));
    return Result<TerrainModel>(failure(ErrorCode::notFound, "no fractal family"));
  }();
  EXPECT_TRUE(model) << model.error().describe();
  return model->mt;
}

std::string firstViolation(const CopiedMt& copy) {
  const Status status = validate(copy.mt());
  return status ? "" : status.error().message;
}

/// A node somewhere in the middle with a child and a parent node.
std::uint32_t middleNode(const MultiTriangulation& mt) {
  for (std::uint32_t n = mt.nodeCount() / 2;; ++n) {
    bool hasParent = false, hasChild = false;
    for (const std::uint32_t t : mt.floor(NodeId(n))) hasParent |= mt.creator(TriangleId(t)).isValid();
    for (std::uint32_t i = 0; i < mt.ceilingSize(NodeId(n)); ++i)
      hasChild |= mt.remover(mt.slotTriangle(NodeId(n), i)).isValid();
    if (hasParent && hasChild && !mt.isOpen(NodeId(n))) return n;
  }
}

TEST(Validate, AcceptsAnUnspoiltMultitriangulation) {
  EXPECT_EQ(firstViolation(CopiedMt(sample())), "");
}

TEST(Validate, NamesLaw1WhenAFloorIsCreatedByAYoungerNode) {
  CopiedMt copy(sample());
  const std::uint32_t n = middleNode(copy.original);
  copy.floor[copy.slotBegin[n] - 2 * n] = copy.original.rootTriangleCount() + copy.slotBegin[n + 1];
  EXPECT_EQ(firstViolation(copy).substr(0, 5), "law 1");
}

TEST(Validate, NamesLaw2WhenAStarLosesItsShape) {
  CopiedMt copy(sample());
  const std::uint32_t n = middleNode(copy.original);
  std::swap(copy.link[copy.slotBegin[n]], copy.link[copy.slotBegin[n] + 1]);
  EXPECT_EQ(firstViolation(copy).substr(0, 5), "law 2");
}

TEST(Validate, NamesLaw3WhenATriangleHasTheWrongRemover) {
  CopiedMt copy(sample());
  const std::uint32_t n = middleNode(copy.original);
  copy.remover[copy.floor[copy.slotBegin[n] - 2 * n]] = MultiTriangulation::kNone;
  EXPECT_EQ(firstViolation(copy).substr(0, 5), "law 3");
}

TEST(Validate, NamesLaw3WhenAFloorRepeatsATriangle) {
  CopiedMt copy(sample());
  const std::uint32_t n = middleNode(copy.original), at = copy.slotBegin[n] - 2 * n;
  copy.floor[at + 1] = copy.floor[at];
  EXPECT_EQ(firstViolation(copy).substr(0, 5), "law 3");
}

TEST(Validate, NamesLaw6WhenAFloorsErrorExceedsTheSaturatedOne) {
  CopiedMt copy(sample());
  const std::uint32_t n = middleNode(copy.original);
  copy.error[copy.floor[copy.slotBegin[n] - 2 * n]] = OutwardScale::kMaxCode;
  EXPECT_EQ(firstViolation(copy).substr(0, 5), "law 6");
}

TEST(Validate, NamesLaw6WhenASphereIsTooSmall) {
  CopiedMt copy(sample());
  const std::uint32_t n = middleNode(copy.original);
  copy.sphere[n].radius *= 0.5f;
  EXPECT_EQ(firstViolation(copy).substr(0, 5), "law 6");
}

TEST(Validate, NamesLaw6WhenABlockOrAPageMissesANode) {
  const CopiedMt good(sample());
  for (std::size_t entry = 0; entry < good.blocks.error.size(); ++entry) {
    CopiedMt low = good, small = good;
    low.blocks.error[entry] -= 1;
    small.blocks.sphere[entry].radius *= 0.9f;
    EXPECT_EQ(firstViolation(low).substr(0, 12), "law 6: block") << entry;
    EXPECT_EQ(firstViolation(small).substr(0, 26), "law 6: the sphere of block") << entry;
  }
}

TEST(Validate, NamesTheOrderWhenABandOfSaturatedErrorsRises) {
  CopiedMt copy(sample());
  copy.saturatedError.back() = OutwardScale::kMaxCode;
  EXPECT_EQ(firstViolation(copy).substr(0, 5), "order");
}

TEST(Validate, NamesTheSameFirstViolationForAnySpoiltNodes) {
  CopiedMt copy(sample());
  const std::uint32_t n = middleNode(copy.original);
  for (std::uint32_t k = n; k < copy.original.nodeCount(); ++k) copy.sphere[k].radius = 0;
  const std::string first = firstViolation(copy);
  EXPECT_NE(first.find("node " + std::to_string(n)), std::string::npos) << first;
}

TEST(ValidateFront, NamesLaw5OnMissingDoubledAndTurnedTriangles) {
  const MultiTriangulation mt = sample();
  const DomainExtent domain = domainExtent(mt);
  const Cut good = frontOfPrefix(mt, mt.nodeCount() / 3);
  EXPECT_TRUE(validateFront(mt, good, domain));

  Cut missing = good;
  missing.triangles.pop_back();
  EXPECT_FALSE(validateFront(mt, missing, domain));
  Cut doubled = good;
  doubled.triangles.push_back(doubled.triangles.front());
  doubled.ids.push_back(doubled.ids.front());
  EXPECT_FALSE(validateFront(mt, doubled, domain));
  Cut turned = good;
  std::swap(turned.triangles[4][0], turned.triangles[4][1]);
  EXPECT_FALSE(validateFront(mt, turned, domain));
}

TEST(ValidateFront, NamesLaw5OnSetsThatAreNotClosed) {
  const MultiTriangulation mt = sample();
  NodeSet alone(mt.nodeCount(), 0);
  alone[middleNode(mt)] = 1;
  const Status status = validateFront(mt, front(mt, alone), domainExtent(mt));
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message.substr(0, 5), "law 5");
}

}  // namespace
}  // namespace arete
