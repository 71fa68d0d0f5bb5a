// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/table/point_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/geo/crs/reader.h"
#include "io/geo/table/height_table.h"
#include "io/io_fixture.h"
#include "io/table_fixture.h"
#include "io/vector_fixture.h"

namespace arete {
namespace {

using test::csvOf;
using test::TemporaryFolder;
using test::utm;

TEST(PointTable, KeepsTheOtherColumnsOfATextWithTheirNames) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.csv",
                                        "id,Name,x,code,y,slope\n"
                                        "1,\"a, \"\"b\"\"\",10.5,007,20,0.25\n"
                                        "2,,11,010,21,\n");
  const auto table = readPointTable(path, utm());
  ASSERT_TRUE(table) << table.error().describe();
  EXPECT_EQ(table->positions, (std::vector<Vec2>{{10.5, 20}, {11, 21}}));
  const PointAttributes& attributes = table->attributes;
  ASSERT_EQ(attributes.columns.size(), 4u);
  ASSERT_EQ(attributes.rows(), 2u);
  EXPECT_EQ(attributes.columns[0].kind, PointAttributes::Kind::integer);
  EXPECT_EQ(attributes.columns[1].kind, PointAttributes::Kind::text);
  EXPECT_EQ(attributes.columns[2].kind, PointAttributes::Kind::text) << "007 is no number";
  EXPECT_EQ(attributes.columns[3].kind, PointAttributes::Kind::real);
  EXPECT_EQ(attributes.at(0, 1), "a, \"b\"");
  EXPECT_EQ(attributes.at(1, 1), "");
  EXPECT_EQ(attributes.at(1, 2), "010");
  EXPECT_EQ(csvOf(*table, {GroundHeight{.height = 1.5}, std::nullopt}),
            "id,Name,code,slope,x,y,height,below,above\n"
            "1,\"a, \"\"b\"\"\",007,0.25,10.5,20,1.5,0,0\n"
            "2,,010,,11,21,,,\n");
}

TEST(PointTable, TakesAHashInQuotesForTextAndReadsBackWhatIsWrittenOfIt) {
  const TemporaryFolder folder;
  std::string text =
      "# \"sites\", of which two\nsite,x,y # metres\n\"Mast #4, \"\"old\"\"\",10.5,20 # \"gone\"\nb,11,21\n";
  for (const char* round : {"as it came", "as it is written"}) {
    const auto table = readPointTable(folder.write("a.csv", text), utm());
    ASSERT_TRUE(table) << round << ": " << table.error().describe();
    EXPECT_EQ(table->positions, (std::vector<Vec2>{{10.5, 20}, {11, 21}})) << round;
    EXPECT_EQ(table->attributes.at(0, 0), "Mast #4, \"old\"") << round;
    text = csvOf(*table, {GroundHeight{.height = 1.5}, std::nullopt});
  }
}

TEST(PointTable, NamesTheColumnsOfATextWithoutNamesByTheirPlace) {
  const TemporaryFolder folder;
  const auto table = readPointTable(folder.write("a.xyz", "1 2 3 a\n4 5 6\n7 8 9 b c\n"), utm());
  ASSERT_TRUE(table) << table.error().describe();
  ASSERT_EQ(table->attributes.columns.size(), 2u);
  EXPECT_EQ(table->attributes.columns[0].name, "field_3");
  EXPECT_EQ(table->attributes.at(1, 0), "6");
  EXPECT_EQ(table->attributes.at(1, 1), "");
  ASSERT_EQ(table->warnings.size(), 1u);
  EXPECT_NE(table->warnings[0].sentence.find("1 field "), std::string::npos);
}

TEST(PointTable, BringsLongitudeAndLatitudeIntoTheDemsCrsAndStatesThemAsTheyWere) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.csv", "lat,lon\n34,-117\n340,-117\n");
  const auto table = readPointTable(path, utm(), {.lonLat = true});
  ASSERT_TRUE(table) << table.error().describe();
  EXPECT_EQ(table->stated[0], (Vec2{-117, 34}));
  EXPECT_NEAR(table->positions[0].x, 500000, 1e-6);
  EXPECT_TRUE(std::isnan(table->positions[1].x)) << "no latitude, and no row less";
  EXPECT_NE(table->crsWkt.find("WGS 84"), std::string::npos);
  const auto refused = readPointTable(path, {}, {.lonLat = true});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::usage);
}

TEST(PointTable, OfALayerHasARowPerPointAndItsFeatureIds) {
  const TemporaryFolder folder;
  const std::string path = test::writeVector(
      folder.file("a.gpkg"), "GPKG",
      {{"sites", wkbUnknown, {{"POINT (1 2)", 5}, {"MULTIPOINT (3 4, 5 6)", 7}, {nullptr, 9}}}});
  const auto table = readPointTable(path, utm());
  ASSERT_TRUE(table) << table.error().describe();
  ASSERT_EQ(table->stated.size(), 4u);
  EXPECT_EQ(table->stated[2], (Vec2{5, 6}));
  EXPECT_TRUE(std::isnan(table->stated[3].x)) << "a feature without a geometry";
  EXPECT_EQ(table->positions[0], table->stated[0]) << "the DEM's CRS";
  EXPECT_EQ(table->attributes.columns[0].name, "source_fid");
  EXPECT_EQ(table->attributes.at(1, 0), table->attributes.at(2, 0));
  EXPECT_EQ(table->attributes.at(2, 1), "7");
}

TEST(PointTable, SaysWhatItCannotRead) {
  const TemporaryFolder folder;
  const std::string lines = test::writeVector(folder.file("lines.gpkg"), "GPKG",
                                              {{"lines", wkbUnknown, {{"LINESTRING (1 2, 3 4)", 5}}}});
  const auto line = readPointTable(lines, utm());
  ASSERT_FALSE(line);
  EXPECT_EQ(line.error().code, ErrorCode::unsupported);
  EXPECT_EQ(line.error().culprit, lines);
  const auto bare = readPointTable(lines, {});
  EXPECT_FALSE(bare);
  EXPECT_EQ(readPointTable(folder.write("a.csv", "x,y\n1,2\n"), utm(), {.layer = "a"}).error().code,
            ErrorCode::usage);
  EXPECT_EQ(readPointTable(folder.write("b.csv", "x,y\n"), utm()).error().code, ErrorCode::invalidData);
  EXPECT_EQ(readPointTable(folder.file("no.csv"), utm()).error().code, ErrorCode::notFound);
}

}  // namespace
}  // namespace arete
