// SPDX-License-Identifier: GPL-3.0-or-later
//
// The front of the tiny model (tests/io/amt_fixture.h), node by node.
#include "io/store/packed/nodes/front.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "io/amt_fixture.h"

namespace arete::packed {
namespace {

constexpr std::uint32_t kNone = MultiTriangulation::kNone;

class FrontTest : public ::testing::Test {
 protected:
  FrontTest() {
    const TerrainModel model = test::tinyModel();
    arrays_.isLattice = true;
    arrays_.columns = arrays_.rows = 3;
    arrays_.encoding = model.mt.vertices().encoding;
    if (!arrays_.allocate({4, 2, 2, 7, 0, 0}, 1)) throw std::runtime_error("no memory");
    std::ranges::copy(model.mt.arrays().rootTriangles, arrays_.rootTriangles.get());
    arrays_.joinRoot();
  }

  /// Node 0 removes both triangles of the root; its star has four triangles, of which the last three stay.
  std::uint32_t addFirst(Front& front, std::uint64_t left) {
    EXPECT_TRUE(front.takeBorder(0, 0, 0, floor_, 0));
    EXPECT_TRUE(front.takeAcross(2, 0, floor_, 1));
    floor_.size = 2;
    floor_.corners = 4;
    floor_.isOpen = false;
    for (const int i : {0, 1, 2, 3}) {
      floor_.link[i] = static_cast<std::uint32_t>(i);
      floor_.outer[i] = kNoSide;
    }
    return front.addStar<4>(0, 0, floor_, 0b1110, left)[0];
  }

  /// Node 1 has the floor (4, 0, 1), of which the edge from 0 to 1 is the border: an open star.
  void addSecond(Front& front) {
    const Side afterApex = floor_.words[Floor::kAcross], beforeApex = floor_.words[Floor::kAcross + 2];
    floor_.size = 1;
    floor_.corners = 3;
    floor_.isOpen = true;
    floor_.link = {1, 4, 0};
    floor_.outer = {beforeApex, afterApex, kNoSide};
    front.addStar<0>(1, 4, floor_, 0b11, 0);
  }

  Arrays arrays_;
  FrontSpace space_;
  Floor floor_;
};

TEST_F(FrontTest, GivesAFloorWithItsCornersAndWhatLiesAcross) {
  Packet packet;
  Front front(arrays_, packet, space_);
  ASSERT_TRUE(front.takeBorder(0, 0, 0, floor_, 0));
  EXPECT_EQ(floor_.id(0), 0u);
  EXPECT_EQ(floor_.words[0], 0u);
  EXPECT_EQ(floor_.words[2], 2u);
  EXPECT_EQ(floor_.words[Floor::kAcross], kNoSide);
  ASSERT_TRUE(front.takeAcross(2, 0, floor_, 1));
  EXPECT_EQ(floor_.id(1), 1u);
  // From the edge that was crossed: 0 to 2.
  EXPECT_EQ(floor_.words[8], 0u);
  EXPECT_EQ(floor_.words[9], 2u);
  EXPECT_EQ(floor_.words[10], 3u);
  EXPECT_EQ(arrays_.remover[0], 0u);
  EXPECT_EQ(arrays_.remover[1], 0u);
}

TEST_F(FrontTest, RefusesATriangleThatIsGoneAndAnEdgeWithNothingAcross) {
  Packet packet;
  Front front(arrays_, packet, space_);
  ASSERT_TRUE(front.takeBorder(0, 0, 0, floor_, 0));
  EXPECT_FALSE(front.takeBorder(0, 0, 0, floor_, 1));
  EXPECT_FALSE(front.takeAcross(0, 0, floor_, 1));
}

TEST_F(FrontTest, ReplacesFloorsByStarsUntilNothingIsLeft) {
  Packet packet;
  packet.nodes = 2;
  Front front(arrays_, packet, space_);
  const std::uint32_t record = addFirst(front, 0);
  EXPECT_EQ(arrays_.star[0], 4);
  for (const std::uint32_t i : {0u, 1u, 2u, 3u}) EXPECT_EQ(arrays_.link[i], i);
  EXPECT_EQ(arrays_.remover[2], Arrays::kMark | record);
  EXPECT_FALSE(Arrays::isLeft(arrays_.remover[2]));
  EXPECT_FALSE(front.take({record, 3}, 1, floor_, 0));
  ASSERT_TRUE(front.take({record, 2}, 1, floor_, 0));
  EXPECT_FALSE(front.take({record, 2}, 1, floor_, 0));
  EXPECT_EQ(arrays_.remover[2], 1u);
  EXPECT_EQ(floor_.words[0], 4u);
  EXPECT_EQ(floor_.words[1], 0u);
  EXPECT_EQ(floor_.words[2], 1u);
  EXPECT_EQ(floor_.words[Floor::kAcross + 1], kNoSide);
  addSecond(front);
  EXPECT_TRUE(arrays_.isOpen(1));
  EXPECT_EQ(arrays_.starSize(1), 3u);
  EXPECT_EQ(arrays_.link[4], 1u);
  EXPECT_EQ(arrays_.link[6], 0u);
  EXPECT_EQ(arrays_.remover[8], 1u);
  EXPECT_TRUE(front.finish(true));
}

TEST_F(FrontTest, DoesNotEndWhileATriangleWaitsForItsRemover) {
  Packet packet;
  packet.nodes = 1;
  Front front(arrays_, packet, space_);
  addFirst(front, 0);
  EXPECT_FALSE(front.finish(true));
}

TEST_F(FrontTest, LeavesATriangleToAnotherPacket) {
  Packet first;
  first.nodes = 1;
  first.borders = 1;
  Front front(arrays_, first, space_);
  addFirst(front, 1);
  ASSERT_TRUE(front.finish(true));
  // Behind the two borders of the root.
  EXPECT_EQ(arrays_.remover[2], Arrays::kMarks | 2);
  EXPECT_EQ(arrays_.border[2].id, 2u);
  EXPECT_EQ(arrays_.border[2].corners, (std::array<std::uint32_t, 3>{4, 0, 1}));
  EXPECT_EQ(arrays_.border[2].across[1], kNone);

  Packet second;
  second.nodes = 1;
  second.firstBorder = 1;
  FrontSpace space;
  Front other(arrays_, second, space);
  ASSERT_TRUE(other.takeBorder(2, 0, 1, floor_, 0));
  EXPECT_EQ(arrays_.remover[2], 1u);
  addSecond(other);
  EXPECT_TRUE(other.finish(true));
}

TEST_F(FrontTest, CountsTheTrianglesThatAreLeft) {
  Packet packet;
  packet.nodes = 1;
  packet.borders = 0;
  Front front(arrays_, packet, space_);
  addFirst(front, 1);
  EXPECT_FALSE(front.finish(true));
}

TEST(Front, HoldsAsManyRecordsAsItCanNumber) {
  EXPECT_TRUE(Front::canHold(0, 0));
  EXPECT_TRUE(Front::canHold(Front::kMostRecords / 2, 0));
  EXPECT_FALSE(Front::canHold(Front::kMostRecords / 2 + 1, 0));
  EXPECT_FALSE(Front::canHold(Front::kMostRecords / 2, 2));
}

}  // namespace
}  // namespace arete::packed
