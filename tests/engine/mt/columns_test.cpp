// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mt/columns.h"

#include <gtest/gtest.h>

#include <vector>

#include "engine/family_models.h"

namespace arete {
namespace {

TEST(Columns, AreEmptyWhereThereIsNone) {
  const Columns none;
  EXPECT_TRUE(none.of(kBelow).empty());
  EXPECT_TRUE(none.of(kAbove).empty());
  EXPECT_TRUE(none.of(kRms).empty());
}

TEST(Columns, HoldWhatWasSetUntilItIsDropped) {
  const std::vector<std::uint16_t> one{1, 2, 3}, other{4, 5};
  Columns columns;
  columns.set(kBelow, one);
  columns.set(kRms, other);
  EXPECT_EQ(columns.of(kBelow).data(), one.data());
  EXPECT_EQ(columns.of(kBelow).size(), 3u);
  EXPECT_EQ(columns.of(kRms).data(), other.data());
  EXPECT_TRUE(columns.of(kAbove).empty());
  const Columns copy = columns;
  columns.drop(kBelow);
  EXPECT_TRUE(columns.of(kBelow).empty());
  EXPECT_EQ(columns.of(kRms).size(), 2u);
  EXPECT_EQ(copy.of(kBelow).size(), 3u);
}

TEST(Columns, OfAHeightfieldAreItsBoundsForEachTriangleId) {
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    EXPECT_EQ(mt.column(kBelow).size(), mt.triangleIdCount()) << m.name;
    EXPECT_EQ(mt.column(kAbove).size(), mt.triangleIdCount()) << m.name;
    EXPECT_TRUE(mt.column(kRms).empty()) << m.name;
  }
}

}  // namespace
}  // namespace arete
