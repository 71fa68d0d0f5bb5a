// SPDX-License-Identifier: GPL-3.0-or-later
//
// The reader against what is on record about real DEMs of many formats, units and frames.
#include <algorithm>
#include <cctype>
#include <cmath>

#include "io/geo/dem/raster_reader.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

using ::testing::internal::CaptureStderr;
using ::testing::internal::GetCapturedStderr;

RasterHeightfield readRealOrFail(const std::string& path, const RasterReadOptions& options = {}) {
  auto read = readRaster(path, options);
  if (!read) {
    ADD_FAILURE() << read.error().describe();
    return {};
  }
  return std::move(read->heightfield);
}

struct RealDem {
  const char* name;
  std::uint32_t columns, rows;
  double lowest, highest;
  std::size_t holes;
  const char* datum;
  std::optional<int> band;
};

void PrintTo(const RealDem& dem, std::ostream* out) {
  *out << dem.name;
}

class RealDems : public ::testing::TestWithParam<RealDem> {};

TEST_P(RealDems, HaveTheSizeRangeAndHolesOnRecord) {
  const RealDem& fact = GetParam();
  const std::string path = test::realData(fact.name);
  if (path.empty()) GTEST_SKIP() << "the real data is not here; ARETE_DATA names its folder";
  RasterReadOptions options;
  options.band = fact.band;
  CaptureStderr();
  const RasterHeightfield read = readRealOrFail(path, options);
  EXPECT_EQ(GetCapturedStderr(), "");
  EXPECT_EQ(read.columns, fact.columns);
  EXPECT_EQ(read.rows, fact.rows);
  EXPECT_EQ(read.georeference.verticalDatum, fact.datum);
  double lowest = HUGE_VAL, highest = -HUGE_VAL;
  std::size_t holes = 0;
  for (const double height : read.heights) {
    if (std::isnan(height)) {
      ++holes;
      continue;
    }
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  EXPECT_EQ(lowest, fact.lowest);
  EXPECT_EQ(highest, fact.highest);
  EXPECT_EQ(holes, fact.holes);
  EXPECT_TRUE(read.validate());
}

INSTANTIATE_TEST_SUITE_P(
    RasterReader, RealDems,
    ::testing::Values(
        RealDem{"dem/dted0_n43.dt0", 121, 121, 75, 460, 0, "MSL", {}},
        RealDem{"dem/dted0_n43.tif", 121, 121, 75, 460, 0, "MSL", {}},
        RealDem{"dem/lidar2m_maungawhau_nztm.tif", 708, 708, 64.55139923095703, 195.6529998779297, 0, "", {}},
        RealDem{"dem/lidar_dsm2.5m_edinburgh_bng.tif",
                815,
                563,
                33.77159118652344,
                250.80966186523438,
                0,
                "",
                {}},
        RealDem{
            "dem/moon_lola_ldem4.cub", 1440, 720, 1737400 - 17757 * 0.5, 1737400 + 21008 * 0.5, 0, "", {}},
        RealDem{
            "dem/ned13_colorado_roi_nad83.tif", 1007, 633, 2543.02001953125, 3946.135498046875, 0, "", {}},
        RealDem{"dem/srtm1_N48W125_juan_de_fuca.hgt.zip", 3601, 3601, -13, 1095, 6483876, "", {}},
        RealDem{"dem/srtm1_bigtujunga_utm11.tif", 1197, 643, 315, 2295, 0, "", {}},
        RealDem{"dem/srtm3_N43E007_nice.hgt.zip", 1201, 1201, -11, 2064, 1595, "", {}},
        RealDem{"dem/srtm3_N46E008_bernese_alps.tif", 1201, 1201, 187, 4173, 103743, "EGM96", {}},
        RealDem{"dem/srtm3_N51E000_thames.hgt.zip", 1201, 1201, -17, 274, 7, "", {}},
        RealDem{"dem/srtm3_N51E001_thames.hgt.zip", 1201, 1201, -9, 191, 0, "", {}},
        RealDem{"dem/srtm3_S33W071_aconcagua.tif", 1201, 1201, 250, 6929, 0, "EGM96", {}},
        RealDem{"dem/srtm3_zion_cc0.tif", 465, 457, 1024, 2892, 0, "", {}},
        RealDem{"dem/terrarium_11_385_803_grandcanyon.png", 256, 256, 130, 137, 0, "", 1},
        RealDem{"dem/tiny_compound_utm32_egm08.tif", 20, 20, 74, 255, 0, "EGM08_Geoid", {}},
        RealDem{"dem/usgsdem_mt_st_helens.dem", 327, 468, 682, 2543, 4151, "", {}},
        RealDem{"drape/olinda_L7_ETMs.tif", 349, 352, 47, 255, 0, "", 1},
        RealDem{"drape/olinda_dem_utm25s.tif", 111, 111, -1, 88, 0, "", {}},
        RealDem{
            "drape/sba_elev32_wgs84_512x512.tif", 512, 512, 2.529711961746216, 20.73138427734375, 0, "", {}},
        RealDem{"drape/sba_rgb_wgs84_512x512.tif", 512, 512, 5, 253, 0, "", 1},
        RealDem{"drape/zion_nlcd_landcover_utm12.tif", 1073, 1359, 1, 8, 0, "", {}}),
    [](const ::testing::TestParamInfo<RealDem>& fact) {
      std::string name = std::filesystem::path(fact.param.name).filename().string();
      std::replace_if(
          name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
      return name;
    });

TEST(RasterReaderOnRealData, KnowsTheMoonForASphere) {
  const std::string path = test::realData("dem/moon_lola_ldem4.cub");
  if (path.empty()) GTEST_SKIP() << "the real data is not here; ARETE_DATA names its folder";
  const RasterHeightfield read = readRealOrFail(path);
  EXPECT_EQ(read.georeference.semiMajorAxisMetres, 1737400);
  EXPECT_EQ(read.georeference.inverseFlattening, 0);
  EXPECT_FALSE(read.georeference.isGeographic);
  EXPECT_EQ(read.rawScale, 0.5);
  EXPECT_EQ(read.rawOffset, 1737400);
}

TEST(RasterReaderOnRealData, PlacesAnHgtByTheNameInsideItsZip) {
  const std::string path = test::realData("dem/srtm1_N48W125_juan_de_fuca.hgt.zip");
  if (path.empty()) GTEST_SKIP() << "the real data is not here; ARETE_DATA names its folder";
  const Georeference g = readRealOrFail(path).georeference;
  EXPECT_TRUE(g.isGeographic);
  const Vec2 first = g.toSource(0, 0), last = g.toSource(3600, 3600);
  EXPECT_NEAR(first.x, -125, 1e-9);
  EXPECT_NEAR(first.y, 49, 1e-9);
  EXPECT_NEAR(last.x, -124, 1e-9);
  EXPECT_NEAR(last.y, 48, 1e-9);
}

TEST(RasterReaderOnRealData, RefusesTheRealPicturesWithoutABand) {
  for (const char* name : {"dem/terrarium_11_385_803_grandcanyon.png", "drape/sba_rgb_wgs84_512x512.tif",
                           "drape/olinda_L7_ETMs.tif"}) {
    const std::string path = test::realData(name);
    if (path.empty()) GTEST_SKIP() << "the real data is not here; ARETE_DATA names its folder";
    const auto read = readRaster(path);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::unsupported);
  }
}

}  // namespace
}  // namespace arete
