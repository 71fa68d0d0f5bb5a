// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/extract/region_argument.h"

#include <gtest/gtest.h>

#include "io/georeference_fixture.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

using test::TemporaryFolder;

TEST(RegionArgument, IsABoxOrAFile) {
  const auto box = readRegionArgument({"1, -2,3,4e1"}, {}, {});
  ASSERT_TRUE(box);
  EXPECT_EQ(box->shape.rings, (std::vector<std::vector<Vec2>>{{{1, -2}, {3, -2}, {3, 40}, {1, 40}}}));
  for (const char* text : {"1,2,3", "1,2,3,4,5", "3,0,1,9", "0,5,1,5", "0,0,inf,1", "0,0,nan,1"})
    EXPECT_EQ(readRegionArgument({text}, {}, {}).error().code, ErrorCode::usage) << text;
  EXPECT_EQ(readRegionArgument({"no,such,file"}, {}, {}).error().code, ErrorCode::notFound);

  const TemporaryFolder folder;
  const std::string file = folder.write(
      "r.geojson", R"({"type":"Polygon","coordinates":[[[-117,34],[-116,34],[-116,35],[-117,34]]]})");
  EXPECT_TRUE(readRegionArgument({file}, test::georeferenceOf("EPSG:32611"), {}));
  EXPECT_EQ(readRegionArgument({file}, {}, {}).error().code, ErrorCode::usage);
}

TEST(RegionArgument, HasTheDistanceThatWasGiven) {
  EXPECT_EQ(readRegionArgument({"1,2,3,4"}, {}, {})->shape.distance, 0);
  EXPECT_EQ(readRegionArgument({"1,2,3,4", 25}, {}, {})->shape.distance, 25);
}

TEST(RegionArgument, NamesTheFieldAndTheText) {
  EXPECT_EQ(readRegionArgument({"1,2,3"}, {}, {}).error().culprit, "region 1,2,3");
  const auto error = readRegionArgument({"1,2,three,4"}, {}, {}).error();
  EXPECT_EQ(error.code, ErrorCode::notFound);
  EXPECT_NE(error.message.find("four numbers"), std::string::npos) << error.message;
}

TEST(RegionArgument, OfLinesNeedsADistance) {
  const TemporaryFolder folder;
  const std::string lines =
      folder.write("l.geojson", R"({"type":"LineString","coordinates":[[-117,34],[-116,35]]})");
  const auto refused = readRegionArgument({lines}, test::georeferenceOf("EPSG:4326"), {}).error();
  EXPECT_EQ(refused.code, ErrorCode::usage);
  EXPECT_NE(refused.message.find("`distance`"), std::string::npos) << refused.message;
  const auto corridor = readRegionArgument({lines, 10}, test::georeferenceOf("EPSG:4326"), {});
  ASSERT_TRUE(corridor) << corridor.error().describe();
  EXPECT_EQ(corridor->shape.rings.size(), 1u);
  EXPECT_TRUE(corridor->shape.lines.empty());
}

TEST(RegionArgument, LiesWhereTheDemLies) {
  const auto degrees = test::georeferenceOf("EPSG:4326");
  struct Case {
    const char* box;
    double west;  ///< of the DEM
    std::uint32_t columns;
    std::vector<double> inside, outside;  ///< longitudes
  };
  for (const Case& c :
       {Case{"-180.5,0,-179.5,1", 179, 2, {179.6, 180, 180.4}, {179.4, 180.6}},
        Case{"179.5,0,-179.5,1", 179, 2, {179.6, 180, 180.4}, {179.4, 180.6}},
        Case{"179.5,0,-179.5,1", -181, 2, {-180.4, -180, -179.6}, {-180.6, -179.4}},
        Case{"-10,0,10,1", 0, 360, {5, 355}, {15, 345}}, Case{"350,0,370,1", 0, 360, {5, 355}, {15, 345}},
        Case{"350,0,10,1", -180, 360, {-5, 5}, {-15, 15}},
        Case{"-180,0,180,1", 0, 360, {1, 179, 180, 181, 359}, {}}}) {
    const auto read = readRegionArgument(
        {c.box}, degrees,
        LongitudeTurns(test::georeferenceOf("EPSG:4326", {c.west, 1, 0, 1, 0, -1}), c.columns, 1));
    ASSERT_TRUE(read) << c.box << read.error().describe();
    EXPECT_TRUE(read->warnings.empty());
    const Region region(read->shape);
    for (const double x : c.inside) EXPECT_TRUE(region.contains({x, 0.5})) << c.box << " at " << x;
    for (const double x : c.outside) EXPECT_FALSE(region.contains({x, 0.5})) << c.box << " at " << x;
  }
  EXPECT_EQ(readRegionArgument({"2,0,1,1"}, test::georeferenceOf("EPSG:32611"), {}).error().code,
            ErrorCode::usage)
      << "only longitudes go round";
  const auto elsewhere = readRegionArgument({.text = "-117,34,-116,35", .crs = "EPSG:4326"},
                                            test::georeferenceOf("EPSG:32611"), {});
  ASSERT_TRUE(elsewhere) << elsewhere.error().describe();
  EXPECT_NEAR(elsewhere->shape.rings.at(0).at(0).x, 500000, 1e-3);
}

TEST(RegionArgument, TakesTheShortestEdgesAndDistances) {
  const TemporaryFolder folder;
  // Vertices a tenth of a nanometre, a micrometre and a metre apart.
  const std::string ring = folder.write(
      "r.csv",
      "WKT,id\n\"POLYGON((10 47,10.000000000000002 47,10.00000000001 47,10.00001 47,10.00001 47.00001,10 "
      "47))\",1\n");
  const std::string line =
      folder.write("l.csv", "WKT,id\n\"LINESTRING(10 47,10.000000000000002 47,13 48)\",1\n");
  for (const char* crs : {"EPSG:32632", "EPSG:3035", "EPSG:3857", "EPSG:4326"}) {
    const auto dem = test::georeferenceOf(crs);
    for (const double distance : {0.0, 1e-12, 1e-3, 1.0}) {
      const auto read = readRegionArgument({ring, distance, "EPSG:4326"}, dem, {});
      ASSERT_TRUE(read) << crs << ", " << distance << ": " << read.error().describe();
      EXPECT_GE(read->shape.rings.at(0).size(), 3u);
      EXPECT_LT(read->shape.rings.at(0).size(), 1000u) << crs << ", " << distance;
    }
    for (const double distance : {1e-6, 10.0}) {
      const auto read = readRegionArgument({line, distance, "EPSG:4326"}, dem, {});
      ASSERT_TRUE(read) << crs << ", " << distance << ": " << read.error().describe();
      EXPECT_EQ(read->shape.rings.size(), 1u) << crs << ", " << distance;
    }
  }
  EXPECT_EQ(readRegionArgument({line, 2e6, "EPSG:4326"}, test::georeferenceOf("EPSG:4326"), {}).error().code,
            ErrorCode::usage);
}

TEST(RegionArgument, MayBePointsWithADistance) {
  const TemporaryFolder folder;
  const std::string points =
      folder.write("p.geojson", R"({"type":"MultiPoint","coordinates":[[-117,34],[-117,35]]})");
  const auto refused = readRegionArgument({points}, test::georeferenceOf("EPSG:4326"), {}).error();
  EXPECT_EQ(refused.code, ErrorCode::usage);
  EXPECT_NE(refused.message.find("points"), std::string::npos) << refused.message;
  const auto discs = readRegionArgument({points, 500}, test::georeferenceOf("EPSG:32611"), {});
  ASSERT_TRUE(discs) << discs.error().describe();
  EXPECT_EQ(discs->shape.rings.size(), 2u);
  const std::string plain = folder.write("p.csv", "WKT,id\nPOINT(3 4),1\n");
  const auto without = readRegionArgument({plain, 2}, {}, {});
  ASSERT_TRUE(without) << without.error().describe();
  const Region region(without->shape);
  EXPECT_TRUE(region.contains({3, 5.9}));
  EXPECT_TRUE(region.contains({3, 4}));
  EXPECT_FALSE(region.contains({4.5, 5.5}));
  EXPECT_TRUE(region.meetsTriangle({0, 0}, {9, 0}, {0, 9}));
  EXPECT_TRUE(region.meetsTriangle({4, 4}, {9, 4}, {9, 9}));
  EXPECT_FALSE(region.meetsTriangle({6, 4}, {9, 4}, {9, 9}));
}

}  // namespace
}  // namespace arete
