// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/packed/nodes/arrays.h"

#include <gtest/gtest.h>

#include <map>

#include "io/amt_fixture.h"

namespace arete::packed {
namespace {

constexpr std::uint32_t kNoTriangle = MultiTriangulation::kNone;

/// The arrays of the tiny model, with its root.
void allocateTiny(Arrays& arrays) {
  const TerrainModel model = arete::test::tinyModel();
  const MtArrays& a = model.mt.arrays();
  arrays.isLattice = true;
  arrays.columns = arrays.rows = 3;
  arrays.encoding = a.vertices.encoding;
  arrays.scale = a.scale;
  arrays.metric = a.metric;
  ASSERT_TRUE(arrays.allocate({4, 2, 2, 7, 0, 0}, 1));
  std::ranges::copy(a.rootTriangles, arrays.rootTriangles.get());
}

TEST(PackedArrays, HaveTheSizesThatTheCountsCallFor) {
  Arrays arrays;
  allocateTiny(arrays);
  EXPECT_EQ(arrays.slotBegin.size(), 3u);
  EXPECT_EQ(arrays.link.size(), 7u);
  EXPECT_EQ(arrays.remover.size(), 9u);
  EXPECT_EQ(arrays.floor.size(), 3u);
  EXPECT_EQ(arrays.creatorHint.size(), 1u);
  EXPECT_EQ(arrays.samples.size(), 6u);
  EXPECT_EQ(arrays.plan.size(), 0u);
  EXPECT_EQ(arrays.rawHeights.size(), 12u);
  EXPECT_EQ(arrays.border.size(), 3u);
  EXPECT_EQ(arrays.floatPlaces.size(), 6u);
  EXPECT_EQ(arrays.doublePlaces.size(), 0u);
}

TEST(PackedArrays, HoldPlacesInFloatsWhereTheseAreExact) {
  Arrays arrays;
  arrays.isLattice = true;
  arrays.columns = arrays.rows = 1u << 22;
  arrays.encoding.type = HeightEncoding::Type::float32;
  EXPECT_TRUE(arrays.holdsFloats());
  ++arrays.rows;
  EXPECT_FALSE(arrays.holdsFloats());
  arrays.rows = 5;
  arrays.encoding.type = HeightEncoding::Type::float64;
  EXPECT_FALSE(arrays.holdsFloats());
  arrays.encoding.type = HeightEncoding::Type::int16;
  arrays.isLattice = false;
  EXPECT_FALSE(arrays.holdsFloats());
}

TEST(PackedArrays, JoinTheRootsTrianglesAcrossTheEdgesThatTwoOfThemShare) {
  Arrays arrays;
  allocateTiny(arrays);
  arrays.joinRoot();
  // Triangles {0, 1, 2} and {0, 2, 3} share the edge of 0 and 2: edge 2 of the first, edge 0 of the second.
  EXPECT_EQ(arrays.border[0].across, (std::array<std::uint32_t, 3>{kNoTriangle, kNoTriangle, 1}));
  EXPECT_EQ(arrays.border[1].across, (std::array<std::uint32_t, 3>{0, kNoTriangle, kNoTriangle}));
  EXPECT_EQ(arrays.border[1].corners, (std::array<std::uint32_t, 3>{0, 2, 3}));
  for (std::uint32_t t : {0u, 1u}) {
    EXPECT_TRUE(Arrays::isLeft(arrays.remover[t]));
    EXPECT_EQ(arrays.remover[t] & ~Arrays::kMarks, t);
  }
  EXPECT_FALSE(Arrays::isLeft(5));
  EXPECT_FALSE(Arrays::isLeft(Arrays::kMark | 5));
}

TEST(PackedArrays, FinishWithHintsAndRootTrianglesThatStay) {
  Arrays arrays;
  allocateTiny(arrays);
  arrays.joinRoot();
  arrays.remover[1] = 0;
  arrays.slotBegin[1] = 4;
  arrays.finish(false);
  EXPECT_EQ(arrays.remover[0], kNoTriangle);
  EXPECT_EQ(arrays.remover[1], 0u);
  EXPECT_EQ(arrays.slotBegin[2], 7u);
  EXPECT_EQ(arrays.creatorHint[0], 0u);
}

/// The tiny model before saturation: spheres of stars (their radii negative) and errors of floors.
void fillTiny(Arrays& arrays) {
  const TerrainModel model = arete::test::tinyModel();
  const MtArrays& a = model.mt.arrays();
  std::ranges::copy(a.slotBegin, arrays.slotBegin.get());
  std::ranges::copy(a.link, arrays.link.get());
  std::ranges::copy(a.remover, arrays.remover.get());
  arrays.star[0] = 4;
  arrays.star[1] = 3 | Arrays::kOpen;
  arrays.sphere[0] = {0, 0, 0, -10};
  arrays.sphere[1] = {20, 0, 0, -5};
  arrays.saturatedError[0] = 2 << MultiTriangulation::kBandShift;
  arrays.saturatedError[1] = (2 << MultiTriangulation::kBandShift) + 7;
}

Packet packetOfBoth(std::uint32_t band) {
  Packet packet;
  Run run;
  run.band = band;
  run.nodes = 2;
  run.slots = 7;
  packet.runs = {run};
  return packet;
}

TEST(PackedArrays, SaturateANodesErrorAndSphereWithThoseOfItsChildren) {
  Arrays arrays;
  allocateTiny(arrays);
  fillTiny(arrays);
  const auto problem = saturate(arrays, packetOfBoth(2), false);
  ASSERT_FALSE(problem) << *problem;
  EXPECT_EQ(arrays.saturatedError[0], (2 << MultiTriangulation::kBandShift) + 7);
  // The least ball around those of radius 10 at 0 and radius 5 at 20 has the radius 17.5, at 7.5.
  EXPECT_NEAR(arrays.sphere[0].radius, 17.5, 1e-3);
  EXPECT_NEAR(arrays.sphere[0].x, 7.5, 1e-3);
  const double distance = 20 - double(arrays.sphere[0].x);
  EXPECT_GE(arrays.sphere[0].radius, distance + double(arrays.sphere[1].radius));
}

TEST(PackedArrays, RefuseASaturatedErrorOutsideOfItsBand) {
  Arrays arrays;
  allocateTiny(arrays);
  fillTiny(arrays);
  const auto problem = saturate(arrays, packetOfBoth(3), false);
  ASSERT_TRUE(problem);
  EXPECT_NE(problem->find("node 1 has a saturated error outside of its band"), std::string::npos) << *problem;
}

TEST(PackedArrays, OfAPartHaveSaturatedErrorsOfTheirBandAtLeast) {
  Arrays arrays;
  allocateTiny(arrays);
  fillTiny(arrays);
  EXPECT_FALSE(saturate(arrays, packetOfBoth(3), true));
  EXPECT_EQ(arrays.saturatedError[0], 3 << MultiTriangulation::kBandShift);
}

}  // namespace
}  // namespace arete::packed
