// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is placed otherwise than by a geotransform; what hides samples; blocks that are not there.
#include "io/geo/dem/raster_placement.h"

#include <cpl_string.h>
#include <gdal_utils.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "io/geo/dem/raster_reader.h"
#include "io/geo/gdal/support.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

using test::contains;
using test::joined;
using test::RasterSpec;
using test::TemporaryFolder;
using test::writeRaster;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

RasterSpec withPoints(const std::vector<std::array<double, 4>>& points) {
  RasterSpec spec;
  spec.geoTransform.reset();
  spec.crs.clear();
  spec.adjust = [points](GDALDataset& d) {
    std::vector<GDAL_GCP> gcps(points.size());
    GDALInitGCPs(int(gcps.size()), gcps.data());
    for (std::size_t i = 0; i < points.size(); ++i) {
      gcps[i].dfGCPPixel = points[i][0];
      gcps[i].dfGCPLine = points[i][1];
      gcps[i].dfGCPX = points[i][2];
      gcps[i].dfGCPY = points[i][3];
    }
    OGRSpatialReference crs;
    crs.SetFromUserInput("EPSG:32611");
    d.SetGCPs(int(gcps.size()), gcps.data(), &crs);
    GDALDeinitGCPs(int(gcps.size()), gcps.data());
  };
  return spec;
}

TEST(RasterPlacement, TakesGroundControlPointsOnAGridOfEqualSteps) {
  TemporaryFolder folder;
  std::mt19937 random(20);
  std::uniform_real_distribution<double> place(0, 3), step(1, 40);
  for (int round = 0; round < 20; ++round) {
    const std::array<double, 6> g = {
        5e5,          step(random), round % 2 ? step(random) / 10 : 0, 4e6, round % 2 ? step(random) / 10 : 0,
        -step(random)};
    std::vector<std::array<double, 4>> points;
    for (int i = 0; i < 4 + round % 3; ++i) {
      const double p = i < 4 ? 3.0 * (i % 2) : place(random), l = i < 4 ? 2.0 * (i / 2) : place(random);
      points.push_back({p, l, g[0] + p * g[1] + l * g[2], g[3] + p * g[4] + l * g[5]});
    }
    const auto read = readRaster(writeRaster(folder.file("gcp.tif"), withPoints(points)));
    ASSERT_TRUE(read) << read.error().describe();
    const Georeference& found = read->heightfield.georeference;
    EXPECT_TRUE(found.hasGeoTransform);
    EXPECT_TRUE(contains(found.crsWkt, "UTM zone 11N"));
    const Vec2 at = found.toSource(1, 1);
    EXPECT_NEAR(at.x, g[0] + 1.5 * g[1] + 1.5 * g[2], 1e-6) << "seed 20, round " << round;
    EXPECT_NEAR(at.y, g[3] + 1.5 * g[4] + 1.5 * g[5], 1e-6);

    // One point off the grid by a tenth of a pixel.
    points.back()[2] += 0.1 * g[1];
    const auto bent = readRaster(writeRaster(folder.file("bent.tif"), withPoints(points)));
    ASSERT_FALSE(bent);
    EXPECT_EQ(bent.error().code, ErrorCode::unsupported);
    EXPECT_TRUE(contains(bent.error().message, "ground control points")) << bent.error().describe();
  }
}

TEST(RasterPlacement, RefusesByNameWhatStandsOnNoGrid) {
  TemporaryFolder folder;
  RasterSpec rpc;
  rpc.geoTransform.reset();
  rpc.crs.clear();
  rpc.adjust = [](GDALDataset& d) {
    CPLStringList items;
    for (const char* name : {"LINE_OFF", "SAMP_OFF", "LAT_OFF", "LONG_OFF", "HEIGHT_OFF", "LINE_SCALE",
                             "SAMP_SCALE", "LAT_SCALE", "LONG_SCALE", "HEIGHT_SCALE"})
      items.SetNameValue(name, "1");
    for (const char* name : {"LINE_NUM_COEFF", "LINE_DEN_COEFF", "SAMP_NUM_COEFF", "SAMP_DEN_COEFF"})
      items.SetNameValue(name, "1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0");
    d.SetMetadata(items.List(), "RPC");
  };
  const std::string lattice = writeRaster(folder.file("x.tif"), {});
  const std::string curved =
      folder.write("curved.vrt",
                   "<VRTDataset rasterXSize=\"3\" rasterYSize=\"2\"><Metadata domain=\"GEOLOCATION\"><MDI "
                   "key=\"X_DATASET\">" +
                       lattice + "</MDI><MDI key=\"X_BAND\">1</MDI><MDI key=\"Y_DATASET\">" + lattice +
                       "</MDI><MDI key=\"Y_BAND\">1</MDI></Metadata><VRTRasterBand dataType=\"Int16\" "
                       "band=\"1\"><SimpleSource>"
                       "<SourceFilename>" +
                       lattice + "</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>");
  for (const auto& [path, word] :
       {std::pair{writeRaster(folder.file("rpc.tif"), rpc), "gdalwarp -rpc"}, {curved, "gdalwarp -geoloc"}}) {
    const auto read = readRaster(path);
    ASSERT_FALSE(read) << path;
    EXPECT_EQ(read.error().code, ErrorCode::unsupported);
    EXPECT_TRUE(contains(read.error().describe(), word) && contains(read.error().describe(), path))
        << read.error().describe();
  }
}

TEST(HiddenSamples, AreNodataForEveryTypeOfSampleAndOpacity) {
  TemporaryFolder folder;
  for (const GDALDataType type : {GDT_Byte, GDT_UInt16, GDT_Int16, GDT_Int32, GDT_Float32, GDT_Float64})
    for (const bool hasNodata : {false, true})
      for (const int bands : {2, 3}) {
        RasterSpec spec;
        spec.type = type;
        spec.bands = bands;
        spec.values = {7, 0, 3, 4, 5, 0};
        spec.adjust = [&](GDALDataset& d) {
          d.GetRasterBand(bands)->SetColorInterpretation(GCI_AlphaBand);
          if (hasNodata) d.GetRasterBand(1)->SetNoDataValue(3);
        };
        SCOPED_TRACE(std::string(GDALGetDataTypeName(type)) + (hasNodata ? " NODATA " : " ") +
                     std::to_string(bands));
        RasterReadOptions options;
        options.band = 1;
        const auto read = readRaster(writeRaster(folder.file("alpha.tif"), spec), options);
        ASSERT_TRUE(read) << read.error().describe();
        const std::vector<double> wanted = {7, kNoNumber, hasNodata ? kNoNumber : 3, 4, 5, kNoNumber};
        for (std::size_t i = 0; i < wanted.size(); ++i)
          EXPECT_TRUE(read->heightfield.heights[i] == wanted[i] ||
                      (std::isnan(wanted[i]) && std::isnan(read->heightfield.heights[i])))
              << i << ": " << read->heightfield.heights[i];
      }
}

TEST(HiddenSamples, AreTheCollarThatGdalwarpMarks) {
  registerGdal();
  TemporaryFolder folder;
  RasterSpec spec;
  spec.type = GDT_Float32;
  spec.columns = spec.rows = 30;
  spec.values.assign(900, 500);
  const std::string path = writeRaster(folder.file("dem.tif"), spec), warped = folder.file("warped.tif");
  GdalDatasetPtr source = openGdal(path, GDAL_OF_RASTER);
  CPLStringList words;
  for (const char* word : {"-t_srs", "EPSG:32612", "-dstalpha"}) words.AddString(word);
  GDALWarpAppOptions* options = GDALWarpAppOptionsNew(words.List(), nullptr);
  GDALDatasetH handle = GDALDataset::ToHandle(source.get());
  GDALClose(GDALWarp(warped.c_str(), nullptr, 1, &handle, options, nullptr));
  GDALWarpAppOptionsFree(options);
  const auto read = readRaster(warped);
  ASSERT_TRUE(read) << read.error().describe();
  std::size_t hidden = 0;
  for (const double height : read->heightfield.heights) {
    EXPECT_TRUE(std::isnan(height) || std::abs(height - 500) < 1e-3) << height;
    hidden += std::isnan(height) ? 1 : 0;
  }
  EXPECT_GT(hidden, 0u);
  EXPECT_LT(hidden, read->heightfield.heights.size() / 2);
}

TEST(AbsentBlocks, OfASparseFileAreNodataAndCounted) {
  TemporaryFolder folder;
  std::mt19937 random(9);
  for (const auto& [columns, rows] : {std::pair{64, 64}, {70, 50}, {16, 33}, {100, 17}}) {
    for (const bool hasNodata : {false, true}) {
      GDALAllRegister();
      CPLStringList options;
      for (const char* option : {"SPARSE_OK=TRUE", "TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16"})
        options.AddString(option);
      const std::string path = folder.file("sparse.tif");
      GDALDataset* dataset = GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
          path.c_str(), columns, rows, 1, GDT_Int16, options.List());
      double transform[] = {500000, 30, 0, 4000000, 0, -30};
      dataset->SetGeoTransform(transform);
      if (hasNodata) dataset->GetRasterBand(1)->SetNoDataValue(-32768);
      std::vector<bool> there;
      std::size_t absent = 0;
      std::vector<std::int16_t> block(256, 77);
      for (int y = 0; y < rows; y += 16)
        for (int x = 0; x < columns; x += 16) {
          there.push_back(there.empty() || random() % 2 == 0);
          const int w = std::min(16, columns - x), h = std::min(16, rows - y);
          if (!there.back()) absent += std::size_t(w) * std::size_t(h);
          if (there.back()) {
            ASSERT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Write, x, y, w, h, block.data(), w, h, GDT_Int16,
                                                          0, 0, nullptr),
                      CE_None);
          }
        }
      GDALClose(GDALDataset::ToHandle(dataset));
      const auto read = readRaster(path);
      ASSERT_TRUE(read) << read.error().describe();
      const int across = (columns + 15) / 16;
      for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
          const double height = read->heightfield.at(unsigned(x), unsigned(y));
          if (there[std::size_t(y / 16 * across + x / 16)])
            ASSERT_EQ(height, 77);
          else
            ASSERT_TRUE(std::isnan(height)) << height;
        }
      const std::string sentence = std::to_string(absent) + " samples lie in blocks";
      EXPECT_EQ(contains(joined(read->warnings), sentence), absent > 0) << joined(read->warnings) << sentence;

      // A virtual raster reads absent blocks as 0 where nothing declares NODATA.
      const std::string size =
          " xSize=\"" + std::to_string(columns) + "\" ySize=\"" + std::to_string(rows) + "\"";
      const std::string over = folder.write(
          "over.vrt",
          "<VRTDataset rasterXSize=\"" + std::to_string(columns + 5) + "\" rasterYSize=\"" +
              std::to_string(rows + 3) + "\"><VRTRasterBand dataType=\"Int16\" band=\"1\"" + ">" +
              (hasNodata ? "<NoDataValue>-32768</NoDataValue>" : "") + "<SimpleSource><SourceFilename>" +
              path + "</SourceFilename><SourceBand>1</SourceBand><SrcRect xOff=\"0\" yOff=\"0\"" + size +
              "/><DstRect xOff=\"5\" yOff=\"3\"" + size + "/></SimpleSource></VRTRasterBand></VRTDataset>");
      const auto virtually = readRaster(over);
      if (!hasNodata && absent > 0) {
        ASSERT_FALSE(virtually);
        EXPECT_EQ(virtually.error().code, ErrorCode::unsupported) << virtually.error().describe();
      } else {
        ASSERT_TRUE(virtually) << virtually.error().describe();
        EXPECT_TRUE(std::isnan(virtually->heightfield.at(4, 2)));
        EXPECT_EQ(virtually->heightfield.at(5, 3), 77);
      }
    }
  }
}

TEST(AbsentBlocks, OfAVirtualRasterAreWhatNoSourceCovers) {
  TemporaryFolder folder;
  const std::string tile = writeRaster(folder.file("tile.tif"), {});
  const auto source = [&](int x, int y) {
    return "<SimpleSource><SourceFilename>" + tile +
           "</SourceFilename><SourceBand>1</SourceBand><SrcRect xOff=\"0\" yOff=\"0\" xSize=\"3\" "
           "ySize=\"2\"/><DstRect xOff=\"" +
           std::to_string(x) + "\" yOff=\"" + std::to_string(y) +
           "\" xSize=\"3\" ySize=\"2\"/></SimpleSource>";
  };
  const auto read = readRaster(folder.write(
      "gap.vrt",
      "<VRTDataset rasterXSize=\"8\" rasterYSize=\"5\"><VRTRasterBand dataType=\"Int16\" band=\"1\">" +
          source(0, 0) + source(4, 2) + "</VRTRasterBand></VRTDataset>"));
  ASSERT_TRUE(read) << read.error().describe();
  for (unsigned y = 0; y < 5; ++y)
    for (unsigned x = 0; x < 8; ++x) {
      const bool isCovered = (x < 3 && y < 2) || (x >= 4 && x < 7 && y >= 2 && y < 4);
      const double wanted = !isCovered ? kNoNumber : y < 2 ? 1 + x + 3 * y : 1 + (x - 4) + 3 * (y - 2);
      EXPECT_TRUE(isCovered ? read->heightfield.at(x, y) == wanted : std::isnan(read->heightfield.at(x, y)))
          << x << ", " << y << ": " << read->heightfield.at(x, y);
    }
  EXPECT_TRUE(contains(joined(read->warnings), "28 samples")) << joined(read->warnings);
}

TEST(AbsentFiles, OfAVirtualRasterEndTheReading) {
  TemporaryFolder folder;
  const auto read = readRaster(folder.write(
      "absent.vrt",
      "<VRTDataset rasterXSize=\"3\" rasterYSize=\"2\"><VRTRasterBand dataType=\"Int16\" "
      "band=\"1\"><SimpleSource><SourceFilename>nowhere.tif"
      "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>"));
  ASSERT_FALSE(read);
  EXPECT_TRUE(contains(read.error().message, "nowhere.tif")) << read.error().describe();
}

}  // namespace
}  // namespace arete
