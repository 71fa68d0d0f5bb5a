// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/format/slot_to_node.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "datasets/families.h"
#include "io/amt_fixture.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

using test::built;

/// Holds them against a walk over the nodes, one slot after the other.
void expectOwners(const MultiTriangulation& mt) {
  const MtArrays& a = mt.arrays();
  const SlotToNode owners(a);
  for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) {
    const std::uint32_t begin = a.slotBegin[n], end = a.slotBegin[n + 1];
    for (std::uint32_t slot = begin; slot < end; ++slot) {
      ASSERT_EQ(owners.of(slot), n) << "slot " << slot;
      ASSERT_EQ(owners.after(slot, n), slot + 1 < end ? slot + 1 : begin) << "slot " << slot;
    }
  }
}

TEST(SlotToNode, AreTheNodesWhoseSlotsTheyAre) {
  for (const RasterFamily& family : rasterFamilies()) {
    SCOPED_TRACE(family.name);
    expectOwners(built(build(family.make(90, 80, 8))).mt);
  }
  for (const PointFamily& family : pointFamilies()) {
    SCOPED_TRACE(family.name);
    expectOwners(built(build(family.make(2000, 8))).mt);
  }
}

TEST(SlotToNode, OfNoNodesAreNone) {
  expectOwners(built(build(rasterFamilies()[0].make(2, 2, 1))).mt);
}

}  // namespace
}  // namespace arete
