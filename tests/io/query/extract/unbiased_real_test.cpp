// SPDX-License-Identifier: GPL-3.0-or-later
//
// What --fit unbiased says of itself, on real terrain: alpine and flat, projected and in degrees, with voids,
// a surface of buildings, the Moon. The mean is that of the independent measurement.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <variant>

#include "full_run.h"
#include "io/geo/dem/dem_reader.h"
#include "io/io_fixture.h"
#include "io/query/extract/tin.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

struct RealDem {
  const char* file;
  bool isSmall = false;  ///< the others belong to the larger test matrix
};

class UnbiasedOnRealTerrain : public testing::TestWithParam<RealDem> {};

TEST_P(UnbiasedOnRealTerrain, TheMeanErrorIsBelowTwoPercentOfTheToleranceWithTheSameTriangles) {
  if (!GetParam().isSmall && !test::isFull()) GTEST_SKIP() << "part of ./dev test --full";
  const std::string path = test::realData(GetParam().file);
  if (path.empty()) GTEST_SKIP() << "the real data is not here; ARETE_DATA names its folder";
  SourceReading reading;
  reading.band = 1;
  const auto dem = readDem(path, reading);
  ASSERT_TRUE(dem) << dem.error().describe();
  const auto& field = std::get<RasterHeightfield>(dem->heightfield);
  const auto model = build(field);
  ASSERT_TRUE(model) << model.error().describe();
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double z : field.heights)
    if (!std::isnan(z)) low = std::min(low, z), high = std::max(high, z);
  const TemporaryFolder folder;
  for (const double share : {0.002, 0.01, 0.03}) {
    TinExtractor extractor(*model, "m.amt");
    ExtractRequest request;
    request.criterion.maxError = share * (high - low);
    request.output = folder.file("tin.ply");
    const Result<ExtractedTin> plain = extractor.extract(request);
    ASSERT_TRUE(plain) << plain.error().describe();
    request.criterion.fit = CutFit::unbiased;
    const Result<ExtractedTin> tin = extractor.extract(request);
    ASSERT_TRUE(tin) << tin.error().describe();
    const std::string what =
        fmt::format("{} within {}: mean {} before, {} after", GetParam().file, *request.criterion.maxError,
                    tin->fit->meanBefore, tin->measured->meanError);
    EXPECT_TRUE(tin->isKept) << what;
    EXPECT_EQ(tin->triangles, plain->triangles) << what;
    EXPECT_LT(std::abs(tin->measured->meanError), 0.02 * *request.criterion.maxError) << what;
    EXPECT_LE(tin->measured->errorBeyondRounding, *request.criterion.maxError) << what;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Dems, UnbiasedOnRealTerrain,
    testing::Values(RealDem{"dem/dted0_n43.tif", true}, RealDem{"dem/usgsdem_mt_st_helens.dem", true},
                    RealDem{"dem/lidar2m_maungawhau_nztm.tif"},
                    RealDem{"dem/lidar_dsm2.5m_edinburgh_bng.tif"}, RealDem{"dem/moon_lola_ldem4.cub"},
                    RealDem{"dem/ned13_colorado_roi_nad83.tif"}, RealDem{"dem/srtm1_bigtujunga_utm11.tif"},
                    RealDem{"dem/srtm3_N43E007_nice.hgt.zip"}, RealDem{"dem/srtm3_N46E008_bernese_alps.tif"},
                    RealDem{"dem/srtm3_N51E000_thames.hgt.zip"}, RealDem{"dem/srtm3_S33W071_aconcagua.tif"},
                    RealDem{"dem/srtm3_zion_cc0.tif"}),
    [](const auto& made) {
      std::string name = std::filesystem::path(made.param.file).stem().string();
      std::ranges::replace_if(
          name, [](char c) { return !std::isalnum(c); }, '_');
      return name;
    });

}  // namespace
}  // namespace arete
