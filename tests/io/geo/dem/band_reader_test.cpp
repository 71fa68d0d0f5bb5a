// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/dem/band_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/geo/gdal/support.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

using test::contains;
using test::joined;
using test::RasterSpec;
using test::TemporaryFolder;

struct BandHeights {
  std::vector<double> heights;
  double scale = 1, offset = 0;
};

/// The heights of the first band of a raster made for the test, read strip by strip.
class BandReaderTest : public ::testing::Test {
 protected:
  Result<BandHeights> read(const RasterSpec& spec, std::optional<double> nodata = {}) {
    warnings_.clear();
    const GdalDatasetPtr dataset = openGdal(test::writeRaster(folder_.file("a.tif"), spec), GDAL_OF_RASTER);
    EXPECT_NE(dataset, nullptr);
    GDALRasterBand& band = *dataset->GetRasterBand(1);
    auto reader = BandReader::of(band, nodata);
    if (!reader) return tl::unexpected(reader.error());
    BandHeights read;
    read.scale = reader->scale();
    read.offset = reader->offset();
    const std::size_t columns = std::size_t(band.GetXSize());
    for (int row = 0; row < band.GetYSize(); row += reader->stripRows()) {
      const int count = std::min(reader->stripRows(), band.GetYSize() - row);
      std::vector<double> strip(columns * std::size_t(count));
      if (Status status = reader->read(row, count, strip); !status) return tl::unexpected(status.error());
      read.heights.insert(read.heights.end(), strip.begin(), strip.end());
    }
    reader->report(warnings_);
    return read;
  }
  TemporaryFolder folder_;
  Warnings warnings_;
};

TEST_F(BandReaderTest, StatedNodataReplacesTheDeclaredOne) {
  RasterSpec spec;
  spec.adjust = [](GDALDataset& dataset) { dataset.GetRasterBand(1)->SetNoDataValue(2); };
  const auto declared = read(spec), stated = read(spec, 5);
  ASSERT_TRUE(declared && stated);
  EXPECT_TRUE(std::isnan(declared->heights[1]));
  EXPECT_EQ(stated->heights[1], 2);
  EXPECT_TRUE(std::isnan(stated->heights[4]));
}

TEST_F(BandReaderTest, ScaleAndOffsetApplyBehindNodata) {
  RasterSpec spec;
  spec.adjust = [](GDALDataset& dataset) {
    dataset.GetRasterBand(1)->SetNoDataValue(2);
    dataset.GetRasterBand(1)->SetScale(0.5);
    dataset.GetRasterBand(1)->SetOffset(100);
  };
  const auto read = this->read(spec);
  ASSERT_TRUE(read) << read.error().describe();
  EXPECT_EQ(read->heights[0], 100.5);
  EXPECT_TRUE(std::isnan(read->heights[1]));
  EXPECT_EQ(read->scale, 0.5);
  EXPECT_EQ(read->offset, 100);
}

TEST_F(BandReaderTest, AreWarnedOfWhereTheyAreHugeOrInfinite) {
  RasterSpec spec;
  spec.type = GDT_Float32;
  spec.values = {1, -3.4e38, 3, std::numeric_limits<double>::infinity(), 5, 6};
  const auto read = this->read(spec);
  ASSERT_TRUE(read);
  EXPECT_TRUE(std::isnan(read->heights[3]));
  EXPECT_LT(read->heights[1], -1e38);
  ASSERT_EQ(warnings_.size(), 2u);
  EXPECT_TRUE(contains(joined(warnings_), "`nodata`")) << joined(warnings_);
}

TEST_F(BandReaderTest, RefuseAScaleThatIsNotANumber) {
  for (const double scale : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    RasterSpec spec;
    spec.adjust = [&](GDALDataset& dataset) { dataset.GetRasterBand(1)->SetScale(scale); };
    const auto read = this->read(spec);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::invalidData);
  }
}

TEST_F(BandReaderTest, RefuseComplexNumbers) {
  RasterSpec spec;
  spec.type = GDT_CFloat32;
  const auto read = this->read(spec);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::unsupported);
}

TEST_F(BandReaderTest, AreReadStripByStripInOrder) {
  // More than a million samples in three columns: several strips.
  RasterSpec spec;
  spec.columns = 3;
  spec.rows = 500'000;
  spec.type = GDT_Float64;
  spec.values.clear();
  for (int i = 0; i < spec.columns * spec.rows; ++i) spec.values.push_back(i * 0.1);
  const auto read = this->read(spec);
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->heights.size() == spec.values.size() &&
              std::equal(read->heights.begin(), read->heights.end(), spec.values.begin()));
}

}  // namespace
}  // namespace arete
