// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/dem/raster_writer.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <random>

#include "io/geo/dem/raster_reader.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

using test::TemporaryFolder;
using ::testing::internal::CaptureStderr;
using ::testing::internal::GetCapturedStderr;

constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();

Georeference someFrame() {
  Georeference g;
  g.geoTransform = {500000, 30, 0, 4000000, 0, -30};
  g.hasGeoTransform = true;
  OGRSpatialReference crs;
  crs.SetFromUserInput("EPSG:32611+5703");
  char* wkt = nullptr;
  const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
  crs.exportToWkt(&wkt, options);
  g.crsWkt = wkt;
  CPLFree(wkt);
  g.verticalUnit = "metre";
  return g;
}

std::vector<double> someValues(std::size_t count) {
  std::mt19937 random(7);
  std::vector<double> values(count);
  for (double& value : values) value = 3000 + std::ldexp(double(random() % 100000), -6);
  values[count / 2] = kVoid;
  return values;
}

void expectEqual(const std::vector<double>& read, const std::vector<double>& written, bool asFloat) {
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    const double expected = asFloat ? double(float(written[i])) : written[i];
    if (!(read[i] == expected || (std::isnan(read[i]) && std::isnan(expected)))) {
      ADD_FAILURE() << "sample " << i << ": " << read[i] << ", written " << expected;
      return;
    }
  }
}

TEST(RasterWriter, WritesWhatTheReaderReads) {
  TemporaryFolder folder;
  const std::vector<double> values = someValues(300 * 517);
  const Georeference frame = someFrame();
  for (const auto sample : {GeoTiffOptions::Sample::float32, GeoTiffOptions::Sample::float64}) {
    for (const auto compression : {GeoTiffOptions::Compression::none, GeoTiffOptions::Compression::deflate,
                                   GeoTiffOptions::Compression::zstd}) {
      GeoTiffOptions options;
      options.sample = sample;
      options.compression = compression;
      options.description = "visibility";
      const std::string path = folder.file("out.tif");
      const Status written = writeGeoTiff(path, 300, 517, values, frame, options);
      ASSERT_TRUE(written) << written.error().describe();
      EXPECT_EQ(folder.count(), 1u) << "the temporary file stayed";
      const auto read = readRaster(path);
      ASSERT_TRUE(read) << read.error().describe();
      EXPECT_TRUE(read->warnings.empty()) << read->warnings.front().sentence;
      EXPECT_EQ(read->heightfield.columns, 300u);
      EXPECT_EQ(read->heightfield.rows, 517u);
      expectEqual(read->heightfield.heights, values, sample == GeoTiffOptions::Sample::float32);
      const Georeference& g = read->heightfield.georeference;
      EXPECT_EQ(g.geoTransform, frame.geoTransform);
      EXPECT_EQ(g.verticalUnit, "metre");
      EXPECT_NE(g.verticalDatum.find("NAVD88"), std::string::npos) << g.verticalDatum;
      OGRSpatialReference a, b;
      a.SetFromUserInput(frame.crsWkt.c_str());
      b.SetFromUserInput(g.crsWkt.c_str());
      EXPECT_TRUE(a.IsSame(&b)) << g.crsWkt;
    }
  }
}

TEST(RasterWriter, TilesTheFileAndDeclaresNan) {
  TemporaryFolder folder;
  const std::string path = folder.file("tiled.tif");
  GeoTiffOptions options;
  options.description = "height above ground";
  ASSERT_TRUE(writeGeoTiff(path, 300, 300, someValues(90000), someFrame(), options));
  GDALDataset* dataset = GDALDataset::Open(path.c_str());
  ASSERT_NE(dataset, nullptr);
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  int width = 0, height = 0, declared = 0;
  band.GetBlockSize(&width, &height);
  EXPECT_EQ(width, height);
  EXPECT_LT(width, 300);
  EXPECT_TRUE(std::isnan(band.GetNoDataValue(&declared)));
  EXPECT_TRUE(declared);
  EXPECT_STREQ(band.GetDescription(), "height above ground");
  EXPECT_STREQ(dataset->GetMetadataItem("COMPRESSION", "IMAGE_STRUCTURE"), "DEFLATE");
  GDALClose(GDALDataset::ToHandle(dataset));
}

TEST(RasterWriter, WritesBareNumbersAndRotatedFrames) {
  TemporaryFolder folder;
  const std::vector<double> values = {1, 2, 3, 4, kVoid, 6};
  ASSERT_TRUE(writeGeoTiff(folder.file("bare.tif"), 3, 2, values, Georeference{}));
  auto read = readRaster(folder.file("bare.tif"));
  ASSERT_TRUE(read);
  EXPECT_FALSE(read->heightfield.georeference.hasGeoTransform);
  EXPECT_TRUE(read->heightfield.georeference.crsWkt.empty());
  expectEqual(read->heightfield.heights, values, false);

  Georeference rotated = someFrame();
  rotated.geoTransform = {500000, 30, 5, 4000000, 7, 30};
  ASSERT_TRUE(writeGeoTiff(folder.file("rotated.tif"), 3, 2, values, rotated));
  read = readRaster(folder.file("rotated.tif"));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->heightfield.georeference.geoTransform, rotated.geoTransform);
}

TEST(RasterWriter, KeepsTheFrameOfEveryRealDem) {
  TemporaryFolder folder;
  bool any = false;
  for (const char* name :
       {"dem/moon_lola_ldem4.cub", "dem/usgsdem_mt_st_helens.dem", "dem/srtm3_zion_cc0.tif",
        "dem/lidar_dsm2.5m_edinburgh_bng.tif", "drape/olinda_dem_utm25s.tif"}) {
    const std::string path = test::realData(name);
    if (path.empty()) continue;
    any = true;
    const auto dem = readRaster(path);
    ASSERT_TRUE(dem);
    const RasterHeightfield& h = dem->heightfield;
    GeoTiffOptions options;
    options.sample = GeoTiffOptions::Sample::float64;
    const std::string copy = folder.file("copy.tif");
    ASSERT_TRUE(writeGeoTiff(copy, h.columns, h.rows, h.heights, h.georeference, options));
    const auto read = readRaster(copy);
    ASSERT_TRUE(read) << read.error().describe();
    const Georeference& g = read->heightfield.georeference;
    EXPECT_EQ(read->heightfield.sourceChecksum, h.sourceChecksum) << name;
    EXPECT_EQ(g.geoTransform, h.georeference.geoTransform) << name;
    EXPECT_EQ(g.isGeographic, h.georeference.isGeographic) << name;
    EXPECT_EQ(g.verticalUnit, h.georeference.verticalUnit) << name;
    EXPECT_NEAR(g.semiMajorAxisMetres, h.georeference.semiMajorAxisMetres, 1e-6) << name;
    EXPECT_NEAR(g.inverseFlattening, h.georeference.inverseFlattening, 1e-6) << name;
    EXPECT_FALSE(g.crsWkt.empty()) << name;
  }
  if (!any) GTEST_SKIP() << "the real data is not here; ARETE_DATA names its folder";
}

TEST(RasterWriter, ReplacesAnOlderFileAndItsSidecars) {
  TemporaryFolder folder;
  const std::string path = folder.write("out.tif", "something older");
  folder.write("out.tif.ovr", "overviews of something older");
  folder.write("out.tif.aux.xml", "<PAMDataset><SRS>EPSG:3857</SRS></PAMDataset>");
  ASSERT_TRUE(writeGeoTiff(path, 1, 2, std::vector<double>{1, 2}, Georeference{}));
  EXPECT_EQ(folder.count(), 1u);
  const auto read = readRaster(path);
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->heightfield.georeference.crsWkt.empty());
}

TEST(RasterWriter, LeavesTheOlderFileAloneWhenItFails) {
  TemporaryFolder folder;
  const std::string path = folder.write("out.tif", "something older");
  std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  const Status stopped = writeGeoTiff(path, 1, 2, std::vector<double>{1, 2}, Georeference{}, {}, context);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::interrupted);
  const Status tooLarge = writeGeoTiff(path, 1, 2, std::vector<double>{1, 1e300}, Georeference{});
  ASSERT_FALSE(tooLarge);
  EXPECT_EQ(tooLarge.error().code, ErrorCode::invalidData);
  const Status wrongCount = writeGeoTiff(path, 2, 2, std::vector<double>{1, 2}, Georeference{});
  ASSERT_FALSE(wrongCount);
  EXPECT_EQ(wrongCount.error().code, ErrorCode::invalidData);
  EXPECT_EQ(folder.count(), 1u);
  EXPECT_EQ(std::filesystem::file_size(path), 15u);
}

TEST(RasterWriter, SaysThatAFolderIsNotThere) {
  TemporaryFolder folder;
  CaptureStderr();
  const Status status =
      writeGeoTiff(folder.file("absent/out.tif"), 1, 1, std::vector<double>{1}, Georeference{});
  EXPECT_EQ(GetCapturedStderr(), "");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::notFound);
  EXPECT_EQ(status.error().culprit, folder.file("absent/out.tif"));
}

}  // namespace
}  // namespace arete
