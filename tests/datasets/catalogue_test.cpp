// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets/catalogue.h"

#include <gtest/gtest.h>

#include <set>

namespace arete {
namespace {

TEST(Catalogue, NamesEveryDemOnceWithALicence) {
  std::set<std::string_view> names;
  for (const PublicDem& dem : publicDems()) {
    EXPECT_TRUE(names.insert(dem.name).second) << dem.name;
    EXPECT_FALSE(dem.summary.empty());
    EXPECT_FALSE(dem.licence.empty());
    EXPECT_TRUE(dem.url.starts_with("https://")) << dem.url;
    EXPECT_GT(dem.pixelDegrees, 0);
    if (dem.scene) {
      EXPECT_TRUE(rasterPaths(dem, *dem.scene)) << dem.name;
      EXPECT_LT(sampleBytes(dem, *dem.scene), 100e6) << dem.name;
    }
  }
}

TEST(Catalogue, NamesTilesByTheirLowerLeftCorner) {
  const PublicDem dem = *findPublicDem("copernicus-glo30");
  const auto paths = rasterPaths(dem, {-0.5, -0.5, 0.5, 0.5});
  ASSERT_TRUE(paths);
  ASSERT_EQ(paths->size(), 4u);
  EXPECT_EQ(paths->front(),
            "/vsicurl/https://copernicus-dem-30m.s3.amazonaws.com/Copernicus_DSM_COG_10_S01_00_W001_00_DEM/"
            "Copernicus_DSM_COG_10_S01_00_W001_00_DEM.tif");
  EXPECT_NE(paths->back().find("N00_00_E000"), std::string::npos);
}

TEST(Catalogue, TakesNoTileBeyondABoxThatEndsOnADegree) {
  EXPECT_EQ(rasterPaths(*findPublicDem("terrain-tiles-skadi"), {7, 46, 8, 47})->size(), 1u);
}

TEST(Catalogue, ReadsAMosaicWholeWhateverTheBox) {
  EXPECT_EQ(rasterPaths(*findPublicDem("usgs-3dep-10m"), {-113, 36, -112, 37})->size(), 1u);
}

TEST(Catalogue, PutsAMirrorInPlaceOfTheHost) {
  const PublicDem dem = *findPublicDem("terrain-tiles-skadi");
  EXPECT_EQ(rasterPaths(dem, {7, 46, 8, 47}, "/data/mirror/")->front(),
            "/vsigzip//data/mirror/elevation-tiles-prod/skadi/N46/N46E007.hgt.gz");
  EXPECT_EQ(rasterPaths(dem, {7, 46, 8, 47}, "https://example.org/dems")->front(),
            "/vsigzip//vsicurl/https://example.org/dems/elevation-tiles-prod/skadi/N46/N46E007.hgt.gz");
}

TEST(Catalogue, RefusesBoxesThatMakeNoSense) {
  const PublicDem dem = *findPublicDem("copernicus-glo30");
  for (const Box2 box : {Box2{1, 1, 1, 2}, {2, 1, 1, 2}, {-200, 0, 1, 1}, {0, 0, 1, 91}, {0, 0, 40, 40}}) {
    const auto paths = rasterPaths(dem, box);
    ASSERT_FALSE(paths);
    EXPECT_EQ(paths.error().code, ErrorCode::usage);
  }
}

TEST(Catalogue, SaysWhichNamesThereAreForOneItDoesNotKnow) {
  const auto dem = findPublicDem("atlantis");
  ASSERT_FALSE(dem);
  EXPECT_EQ(dem.error().code, ErrorCode::usage);
  EXPECT_NE(dem.error().message.find("matterhorn"), std::string::npos);
}

}  // namespace
}  // namespace arete
