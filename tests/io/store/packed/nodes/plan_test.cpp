// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/packed/nodes/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "datasets/families.h"
#include "io/amt_fixture.h"
#include "io/store/packed/heightfield/form.h"
#include "terrain/builder/build.h"

namespace arete::packed {
namespace {

using arete::test::built;

/// What plan.h and layout.h promise of a plan.
void expectSound(const TerrainModel& model) {
  const MultiTriangulation& mt = model.mt;
  const Plan plan = planPackets(model.mt, kindOf(model));
  const auto& packets = plan.directory.packets;
  const std::uint32_t roots = mt.rootTriangleCount();
  ASSERT_EQ(plan.packetOf.size(), mt.nodeCount());
  EXPECT_EQ(plan.directory.nodes(), mt.nodeCount());
  EXPECT_EQ(plan.directory.slots(), mt.arrays().link.size());
  std::vector<std::uint32_t> left(packets.size(), 0);
  for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) {
    const std::uint32_t c = plan.packetOf[n];
    ASSERT_LT(c, packets.size());
    std::uint32_t own = 0;
    for (const std::uint32_t t : mt.floor(NodeId(n))) {
      if (t < roots) continue;
      const NodeId parent = mt.creator(TriangleId(t));
      const std::uint32_t other = plan.packetOf[parent.index()];
      ASSERT_GE(plan.band[parent.index()], plan.band[n]);
      if (other == c) {
        ++own;
      } else {
        ++left[other];
        ASSERT_LT(other, c);
        ASSERT_TRUE(std::ranges::binary_search(packets[c].dependsOn, other));
      }
    }
    ASSERT_EQ(plan.ownParents[n], own);
    ASSERT_EQ(std::ranges::binary_search(plan.listed[c], n), own == 0);
    const Vec2 p = mt.vertices().planPosition(mt.apex(NodeId(n)));
    ASSERT_TRUE(p.x >= packets[c].xMin && p.x <= packets[c].xMax && p.y >= packets[c].yMin &&
                p.y <= packets[c].yMax);
  }
  for (std::size_t c = 0; c < packets.size(); ++c) {
    EXPECT_EQ(packets[c].borders, left[c]);
    EXPECT_TRUE(std::ranges::is_sorted(packets[c].dependsOn));
    EXPECT_TRUE(std::ranges::is_sorted(packets[c].runs, std::greater<>(), &Run::band));
    std::uint32_t listed = 0;
    for (const Run& run : packets[c].runs) {
      EXPECT_GT(run.nodes, 0u);
      listed += run.listed;
    }
    EXPECT_EQ(listed, plan.listed[c].size());
  }
}

TEST(PackedPlan, PutsEveryNodeInAPacketAfterThoseOfItsParents) {
  for (const RasterFamily& family : rasterFamilies()) {
    SCOPED_TRACE(family.name);
    expectSound(built(build(family.make(70, 60, 2))));
  }
  for (const PointFamily& family : pointFamilies()) {
    SCOPED_TRACE(family.name);
    expectSound(built(build(family.make(1500, 2))));
  }
}

TEST(PackedPlan, HasManyPacketsWhereThereAreManyTiles) {
  const TerrainModel model =
      built(build(arete::test::hills(600, 300, [](double z) { return std::round(z); })));
  expectSound(model);
  EXPECT_GE(planPackets(model.mt, kindOf(model)).directory.packets.size(), 10u);
}

TEST(PackedPlan, IsTheSameEachTime) {
  const TerrainModel model = built(build(arete::test::hills(300, 280, [](double z) { return z; })));
  const Plan once = planPackets(model.mt, kindOf(model)), again = planPackets(model.mt, kindOf(model));
  EXPECT_EQ(toBytes(once.directory), toBytes(again.directory));
  EXPECT_TRUE(std::ranges::equal(once.packetOf, again.packetOf));
}

TEST(PackedPlan, OfAModelWithoutNodesIsOneEmptyPacket) {
  const TerrainModel model = built(build(rasterFamilies()[0].make(2, 2, 1)));
  const Plan plan = planPackets(model.mt, kindOf(model));
  ASSERT_EQ(plan.directory.packets.size(), 1u);
  EXPECT_TRUE(plan.directory.packets[0].runs.empty());
}

}  // namespace
}  // namespace arete::packed
