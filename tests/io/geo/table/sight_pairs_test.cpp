// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/table/sight_pairs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/geo/crs/reader.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

class SightPairsFile : public ::testing::Test {
 protected:
  static Georeference utm() {
    Georeference georeference;
    const auto crs = crsFromText("EPSG:32632");
    EXPECT_TRUE(crs);
    EXPECT_TRUE(describeCrs(*crs, georeference));
    return georeference;
  }
  SightPairs read(const std::string& text, const Georeference& dem = {}, bool lonLat = false) const {
    auto pairs = readSightPairs(folder_.write("pairs.csv", text), dem, {.layer = {}, .lonLat = lonLat});
    EXPECT_TRUE(pairs) << pairs.error().describe();
    return pairs ? std::move(*pairs) : SightPairs{};
  }
  std::string errorOf(const std::string& text) const {
    const auto pairs = readSightPairs(folder_.write("pairs.csv", text), {});
    return pairs ? "" : pairs.error().describe();
  }
  test::TemporaryFolder folder_;
};

TEST_F(SightPairsFile, HasItsColumnsByAnyOfTheirNames) {
  for (const char* header : {"x1,y1,h1,x2,y2,h2,name", "FROM_X,From_Y,from_height,to_x,to_y,to_height,name",
                             "tx_x,tx_y,tx_height,rx_x,rx_y,rx_height,name"}) {
    const SightPairs pairs = read(std::string(header) + "\n1,2,3,4,5,6msl,a\n1.5,2,,4,5,98.5ell,\"b,c\"\n");
    ASSERT_EQ(pairs.rows.size(), 2u) << header;
    EXPECT_EQ(pairs.rows[0][0].xy, (Vec2{1, 2}));
    EXPECT_EQ(pairs.rows[0][1].xy, (Vec2{4, 5}));
    EXPECT_EQ(pairs.rows[0][0].height->kind, HeightKind::aboveGround);
    EXPECT_EQ(pairs.rows[0][1].height->height, 6);
    EXPECT_EQ(pairs.rows[0][1].height->kind, HeightKind::seaLevel);
    EXPECT_FALSE(pairs.rows[1][0].height);
    EXPECT_EQ(pairs.rows[1][1].height->kind, HeightKind::ellipsoidal);
    ASSERT_EQ(pairs.attributes.columns.size(), 3u);
    EXPECT_EQ(pairs.attributes.at(1, 2), "b,c");
  }
}

TEST_F(SightPairsFile, MayNameTheSecondEndByAzimuthAndRange) {
  const SightPairs plane = read("x1,y1,azimuth,range\n10,20,90,5\n10,20,0,7\n");
  EXPECT_NEAR(plane.rows[0][1].xy.x, 15, 1e-12);
  EXPECT_NEAR(plane.rows[1][1].xy.y, 27, 1e-12);
  // Over the ellipsoid: the way back has the length, and at the equator of a sphere the azimuth turns round.
  const SightPairs utmPairs = read("x1,y1,azimuth,range\n500000,5200000,90,10000\n", utm());
  EXPECT_NEAR(utmPairs.rows[0][1].xy.x - 500000, 10000 * 0.9996, 0.01);
  EXPECT_NEAR(utmPairs.rows[0][1].stated.x, utmPairs.rows[0][1].xy.x, 1e-9);
  const SightPairs lonLat = read("lon,lat,azimuth,range\n9,47,0,1000\n", utm(), true);
  EXPECT_NEAR(lonLat.rows[0][1].stated.x, 9, 1e-9);
  EXPECT_NEAR(lonLat.rows[0][1].stated.y, 47 + 1000 / 111170.0, 1e-5);
}

TEST_F(SightPairsFile, MayBeALayerOfLinesInAnotherCrs) {
  const std::string path = folder_.write("lines.geojson",
                                         R"({"type":"FeatureCollection","features":[
         {"type":"Feature","properties":{"h1":"30","h2":10.5},"geometry":
          {"type":"LineString","coordinates":[[9,47],[9.05,47.01],[9.1,47]]}}]})");
  const auto pairs = readSightPairs(path, utm());
  ASSERT_TRUE(pairs) << pairs.error().describe();
  ASSERT_EQ(pairs->rows.size(), 1u);
  EXPECT_NEAR(pairs->rows[0][0].xy.x, 500000, 1e-6);
  EXPECT_NEAR(pairs->rows[0][1].stated.x, 9.1, 1e-12);
  EXPECT_EQ(pairs->rows[0][0].height->height, 30);
  EXPECT_EQ(pairs->rows[0][1].height->height, 10.5);
}

TEST_F(SightPairsFile, SaysWhatItLacks) {
  EXPECT_NE(errorOf("a,b\n1,2\n").find("has no columns x1 and y1"), std::string::npos);
  EXPECT_NE(errorOf("x1,y1\n1,2\n").find("nor azimuth and range"), std::string::npos);
  EXPECT_NE(errorOf("x1,y1,x2,y2\n1,2,3,4\n1,z,3,4\n").find("row 2: 'z' is not a number"), std::string::npos)
      << errorOf("x1,y1,x2,y2\n1,2,3,4\n1,z,3,4\n");
  EXPECT_NE(errorOf("x1,y1,x2,y2,h1\n1,2,3,4,tall\n").find("'tall' is not a height"), std::string::npos);
  EXPECT_NE(errorOf("x1,y1,x2,y2\n").find("holds no line"), std::string::npos);
  for (const char* range : {"-3000", "0"})
    EXPECT_NE(errorOf(std::string("x1,y1,azimuth,range\n1,2,20,5\n1,2,200,") + range + "\n")
                  .find("pairs.csv, row 2: has a range that is not above 0"),
              std::string::npos);
  // Where a place says the second end the range does not matter.
  EXPECT_EQ(errorOf("x1,y1,x2,y2,azimuth,range\n1,2,3,4,200,-3000\n"), "");
}

TEST_F(SightPairsFile, OfSitesHasHeightsAndBeams) {
  const std::string path =
      folder_.write("sites.csv", "x,y,height,azimuth,beamwidth,range\n1,2,30,45,60,5000\n3,4,,,,\n");
  const auto sites = readSightSites(path, {});
  ASSERT_TRUE(sites) << sites.error().describe();
  ASSERT_EQ(sites->rows.size(), 2u);
  EXPECT_EQ(sites->rows[0][0].height->height, 30);
  EXPECT_EQ(sites->beams[0].beamwidth, 60);
  EXPECT_EQ(sites->beams[0].range, 5000);
  EXPECT_FALSE(sites->rows[1][0].height);
  EXPECT_TRUE(std::isnan(sites->beams[1].azimuth));
}

}  // namespace
}  // namespace arete
