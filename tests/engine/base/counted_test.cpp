// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/base/counted.h"

#include <gtest/gtest.h>

namespace arete {
namespace {

TEST(Counted, OneIsSingularAndEveryOtherNumberPlural) {
  EXPECT_EQ(counted(0, "triangle", "triangles"), "0 triangles");
  EXPECT_EQ(counted(1, "triangle", "triangles"), "1 triangle");
  EXPECT_EQ(counted(2, "triangle", "triangles"), "2 triangles");
  EXPECT_EQ(counted(11, "vertex", "vertices"), "11 vertices");
  EXPECT_EQ(counted(21, "vertex", "vertices"), "21 vertices");
  EXPECT_EQ(counted(1, "face is left out", "faces are left out"), "1 face is left out");
  EXPECT_EQ(counted(1001, "face is left out", "faces are left out"), "1001 faces are left out");
}

TEST(Counted, TheWordsStandAloneWhereTheNumberIsWrittenOtherwise) {
  EXPECT_EQ(agreeing(1, "row", "rows"), "row");
  EXPECT_EQ(agreeing(0, "row", "rows"), "rows");
}

}  // namespace
}  // namespace arete
