// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/text/wkt_point.h"

#include <gtest/gtest.h>

namespace arete {
namespace {

TEST(WktPoint, HasItsCoordinatesHowEverItIsWritten) {
  struct Case {
    const char* text;
    Vec2 place;
    std::optional<double> z = {};
    int srid = 0;
  };
  for (const Case& c : {
           Case{"POINT (15 47)", {15, 47}},
           Case{"POINT(15 47)", {15, 47}},
           Case{"point ( -1.5e1   +47.25 )", {-15, 47.25}},
           Case{"  POINT (15 47)  ", {15, 47}},
           Case{"POINT Z (15 47 300)", {15, 47}, 300},
           Case{"POINTZ(15 47 300)", {15, 47}, 300},
           Case{"POINT (15 47 300)", {15, 47}, 300},
           Case{"POINT (15 47 300 1)", {15, 47}, 300},
           Case{"POINT M (15 47 1)", {15, 47}},
           Case{"POINT ZM (15 47 300 1)", {15, 47}, 300},
           Case{"POINTZM(15 47 300 1)", {15, 47}, 300},
           Case{"SRID=4326;POINT (15 47)", {15, 47}, {}, 4326},
           Case{"srid=32633;point z(15 47 300)", {15, 47}, 300, 32633},
           Case{"SRID=0;POINT(15 47)", {15, 47}},
           Case{"MULTIPOINT (15 47)", {15, 47}},
           Case{"MULTIPOINT ((15 47))", {15, 47}},
           Case{"MULTIPOINT Z ((15 47 300))", {15, 47}, 300},
           Case{"POINT\t(15\n47)", {15, 47}},
       }) {
    const auto point = readWktPoint(c.text);
    ASSERT_TRUE(point && point->place) << c.text;
    EXPECT_EQ(*point->place, c.place) << c.text;
    EXPECT_EQ(point->z, c.z) << c.text;
    EXPECT_EQ(point->srid, c.srid) << c.text;
  }
  for (const char* empty : {"POINT EMPTY", "point empty", "POINT Z EMPTY", "SRID=4326;POINT EMPTY"}) {
    const auto point = readWktPoint(empty);
    ASSERT_TRUE(point) << empty;
    EXPECT_FALSE(point->place) << empty;
  }
}

TEST(WktPoint, IsNothingElse) {
  for (const char* text : {"",
                           "POINT",
                           "point",
                           "POINT (15)",
                           "POINT (15 47",
                           "POINT 15 47",
                           "POINT (15, 47)",
                           "POINT (a b)",
                           "POINT (15 nan)",
                           "POINT (15 inf)",
                           "POINT (15 47) x",
                           "POINT Z (15 47)",
                           "POINT M (15 47)",
                           "POINT ZM (15 47 1)",
                           "POINT (1 2 3 4 5)",
                           "LINESTRING (0 0, 1 1)",
                           "MULTIPOINT ((1 2),(3 4))",
                           "MULTIPOINT (1 2, 3 4)",
                           "POLYGON ((0 0,1 0,1 1,0 0))",
                           "SRID=x;POINT (1 2)",
                           "SRID=-1;POINT (1 2)",
                           "SRID=4326 POINT (1 2)",
                           "0101000000000000000000F03F0000000000000040",
                           "POINTS (1 2)",
                           "POINT EMPTY (1 2)"})
    EXPECT_FALSE(readWktPoint(text)) << text;
}

}  // namespace
}  // namespace arete
