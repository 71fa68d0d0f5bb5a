// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/dem/dem_reader.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <variant>

#include "io/io_fixture.h"
#include "io/vector_fixture.h"

namespace arete {
namespace {

using test::contains;
using test::joined;
using test::TemporaryFolder;
using test::writeVector;
using ::testing::internal::CaptureStderr;
using ::testing::internal::GetCapturedStderr;

DemRead demOrFail(const std::string& path, const SourceReading& reading = {}) {
  auto read = readDem(path, reading);
  if (!read) {
    ADD_FAILURE() << read.error().describe();
    return {};
  }
  return std::move(*read);
}

Error demErrorOf(const std::string& path, const SourceReading& reading = {}) {
  auto read = readDem(path, reading);
  if (read) ADD_FAILURE() << path << " was read";
  return read ? Error{} : read.error();
}

std::string warningsUnder(const std::string& crs, const std::string& path) {
  SourceReading reading;
  reading.crs = crs;
  return joined(demOrFail(path, reading).warnings);
}

TEST(DemReader, WarnsOfPlacesThatLookLikeDegreesWithoutACrs) {
  TemporaryFolder folder;
  const auto isWarnedOf = [&](const std::string& name, const std::string& text, const std::string& crs = {}) {
    return contains(warningsUnder(crs, folder.write(name, text)), "look like degrees");
  };
  const std::string heights = "310 450\n NaN 1290\n";
  const auto grid = [&](const std::string& corner, const std::string& cell, const std::string& rows) {
    return "ncols 2\nnrows 2\nxllcorner " + corner + "\nyllcorner 46\ncellsize " + cell + "\n" + rows;
  };
  EXPECT_TRUE(isWarnedOf("degrees.asc", grid("8", "0.5", heights)));
  EXPECT_FALSE(isWarnedOf("stated.asc", grid("8", "0.5", heights), "EPSG:4326"));
  EXPECT_FALSE(isWarnedOf("metres.asc", grid("408000", "30", heights)));
  EXPECT_FALSE(isWarnedOf("local.asc", grid("8", "40", "310 312\n 311 309\n")));
  EXPECT_FALSE(isWarnedOf("flat.asc", grid("8", "0.5", "7 7\n7 7\n")));
  EXPECT_TRUE(isWarnedOf("points.csv", "8.1,46.2,310\n8.3,46.9,450\n8.9,46.4,1290\n8.5,46.6,800\n"));
}

TEST(DemReader, WarnsOfPositionsOutOfTheRangeOfACrsOfDegrees) {
  TemporaryFolder folder;
  const auto isWarnedOf = [&](const std::string& name, const std::string& text, const std::string& crs) {
    return contains(warningsUnder(crs, folder.write(name, text)), "which are out of range");
  };
  const auto grid = [&](const std::string& x, const std::string& y, const std::string& cell) {
    return "ncols 2\nnrows 2\nxllcorner " + x + "\nyllcorner " + y + "\ncellsize " + cell + "\n1 2\n3 4\n";
  };
  EXPECT_TRUE(isWarnedOf("utm.asc", grid("408000", "3800000", "30"), "EPSG:4326"));
  EXPECT_FALSE(isWarnedOf("utm-told.asc", grid("408000", "3800000", "30"), "EPSG:32611"));
  EXPECT_TRUE(isWarnedOf("utm.csv", "1,52.5,3\n4,5800000,6\n7.7,8,9\n", "EPSG:4258"));
  EXPECT_FALSE(
      isWarnedOf("pole.asc", grid("179", "89.5", "0.5"), "EPSG:4326"));  // half a cell beyond the pole
  EXPECT_FALSE(isWarnedOf("turns.asc", grid("359", "10", "1"), "EPSG:4326"));
  // Grads: a right angle has a hundred.
  EXPECT_FALSE(isWarnedOf("grads.asc", grid("2", "99", "0.5"), "EPSG:4807"));
}

TEST(DemReader, DecidesByWhatTheFileIs) {
  TemporaryFolder folder;
  CaptureStderr();
  EXPECT_TRUE(std::holds_alternative<RasterHeightfield>(
      demOrFail(test::writeRaster(folder.file("dem.tif"), {})).heightfield));
  const std::string grid = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 5\n1 2\n3 4\n";
  EXPECT_TRUE(
      std::holds_alternative<RasterHeightfield>(demOrFail(folder.write("grid.txt", grid)).heightfield));
  EXPECT_TRUE(std::holds_alternative<PointHeightfield>(
      demOrFail(folder.write("p.csv", "1,2,3\n4,5.5,6\n7.7,8,9\n0,1,1\n")).heightfield));
  EXPECT_TRUE(std::holds_alternative<PointHeightfield>(
      demOrFail(folder.write("p.xyz", "1 2 3\n4 5.5 6\n7.7 8 9\n0 1 1\n")).heightfield));
  EXPECT_TRUE(std::holds_alternative<PointHeightfield>(
      demOrFail(folder.write("noname", "1 2 3\n4 5.5 6\n7.7 8 9\n0 1 1\n")).heightfield));
  EXPECT_TRUE(std::holds_alternative<PointHeightfield>(
      demOrFail(writeVector(folder.file("p.gpkg"), "GPKG", {{"p", wkbPoint25D, {{"POINT Z (1 2 3)", 0}}}}))
          .heightfield));
  EXPECT_EQ(GetCapturedStderr(), "");
}

TEST(DemReader, ReadsTextOnARegularGridAsARasterOfDoubles) {
  TemporaryFolder folder;
  std::string text = "x,y,z\n";
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x)
      if (x != 2 || y != 1) text += fmt::format("{},{},{}\n", 100 + x * 0.333333, 50 + y * 10, x + y * 0.1);
  const DemRead read = demOrFail(folder.write("grid.csv", text));
  ASSERT_TRUE(std::holds_alternative<RasterHeightfield>(read.heightfield));
  const auto& raster = std::get<RasterHeightfield>(read.heightfield);
  EXPECT_EQ(raster.columns, 5u);
  EXPECT_EQ(raster.rows, 4u);
  EXPECT_EQ(raster.at(1, 0), 1 + 3 * 0.1) << "north is up, and 1.3 is no float";
  EXPECT_TRUE(std::isnan(raster.at(2, 2)));
  const Vec2 first = raster.georeference.toSource(0, 0);
  EXPECT_NEAR(first.x, 100, 1e-9);
  EXPECT_NEAR(first.y, 80, 1e-9);
  EXPECT_TRUE(raster.validate());
  EXPECT_TRUE(contains(joined(read.warnings), "5 columns and 4 rows")) << joined(read.warnings);

  // Points whose steps no double can hold are points.
  for (const char* wide : {"-1.7e308 0 1\n1.7e308 0 2\n-1.7e308 1 3\n1.7e308 1 4\n",
                           "0 0 1\n5e-324 0 2\n0 5e-324 3\n5e-324 5e-324 4\n",
                           "0 0 1\n1e-200 0 2\n0 1e-200 3\n1e-200 1e-200 4\n"})
    EXPECT_TRUE(
        std::holds_alternative<PointHeightfield>(demOrFail(folder.write("wide.csv", wide)).heightfield));

  // So are a few points that happen to stand on a lattice.
  EXPECT_TRUE(std::holds_alternative<PointHeightfield>(
      demOrFail(folder.write("few.csv", "0,0,1\n1,3,1\n2,1,5\n3,2,4\n4,4,4\n")).heightfield));

  // And those that fill a lattice by half with hardly a cell of it: four corners and the middle.
  EXPECT_TRUE(std::holds_alternative<PointHeightfield>(
      demOrFail(folder.write("five.csv", "0,0,1\n10,0,2\n0,10,3\n10,10,4\n5,5,9\n")).heightfield));
}

TEST(DemReader, RefusesOptionsOfTheOtherKind) {
  TemporaryFolder folder;
  const std::string raster = test::writeRaster(folder.file("dem.tif"), {});
  const std::string points = folder.write("p.csv", "1,2,3\n4,5.5,6\n7.7,8,9\n");
  SourceReading layer, field, band;
  layer.layer = "peaks";
  field.zField = "elevation";
  band.band = 1;
  for (const auto& [path, reading, sentence] :
       {std::tuple{raster, layer, "is a raster, which has no layer 'peaks'"},
        {raster, field, "is a raster, which has bands and no field 'elevation'"},
        {points, band, "holds points, which have no band 1"}}) {
    const Error error = demErrorOf(path, reading);
    EXPECT_EQ(error.code, ErrorCode::usage);
    EXPECT_EQ(error.describe(), path + ": " + sentence);
  }
}

TEST(DemReader, ReadsPointsFromAnArchiveAsItDoesWithout) {
  TemporaryFolder folder;
  const auto add = [&](const std::string& zip, const std::string& name, const std::string& text) {
    VSILFILE* out = VSIFOpenL(("/vsizip/" + folder.file(zip) + "/" + name).c_str(), "wb");
    ASSERT_NE(out, nullptr);
    VSIFWriteL(text.data(), 1, text.size(), out);
    VSIFCloseL(out);
  };
  add("points.zip", "p.csv", "x,y,z\n1,2,3\n4,5.5,6\n7.7,8,9\n0,1,1\n");
  const DemRead read = demOrFail(folder.file("points.zip"));
  ASSERT_TRUE(std::holds_alternative<PointHeightfield>(read.heightfield));
  EXPECT_EQ(std::get<PointHeightfield>(read.heightfield).size(), 4u);

  const std::string grid = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 5\n1 2\n3 4\n";
  add("both.zip", "dem.asc", grid);
  add("both.zip", "p.csv", "x,y,z\n1,2,3\n4,5.5,6\n7.7,8,9\n0,1,1\n");
  EXPECT_TRUE(std::holds_alternative<RasterHeightfield>(demOrFail(folder.file("both.zip")).heightfield))
      << "text is no raster beside one";
}

TEST(DemReader, PassesItsOptionsOn) {
  TemporaryFolder folder;
  SourceReading reading;
  reading.band = 7;
  EXPECT_EQ(demErrorOf(test::writeRaster(folder.file("dem.tif"), {}), reading).code, ErrorCode::usage);
  reading = {};
  reading.crs = "EPSG:4326";
  const DemRead read = demOrFail(folder.write("p.csv", "1,2,3\n4,5.5,6\n7.7,8,9\n"), reading);
  EXPECT_TRUE(std::get<PointHeightfield>(read.heightfield).georeference.isGeographic);
}

TEST(DemReader, SaysWhatToDoWithPointClouds) {
  TemporaryFolder folder;
  for (const char* name : {"cloud.las", "cloud.LAZ", "renamed.bin"}) {
    const Error error = demErrorOf(folder.write(name, "LASF and so on"));
    EXPECT_EQ(error.code, ErrorCode::unsupported);
    EXPECT_TRUE(contains(error.message, "point cloud")) << error.describe();
  }
  EXPECT_EQ(demErrorOf(folder.file("absent.laz")).code, ErrorCode::notFound);
}

TEST(DemReader, SaysWhyAFileCannotBeRead) {
  TemporaryFolder folder;
  CaptureStderr();
  EXPECT_EQ(demErrorOf(folder.file("absent.tif")).describe(),
            folder.file("absent.tif") + ": there is no such file");
  EXPECT_EQ(demErrorOf(folder.file("absent.csv")).code, ErrorCode::notFound);
  EXPECT_EQ(demErrorOf(folder.file("absent.zip")).code, ErrorCode::notFound);
  EXPECT_EQ(demErrorOf(folder.write("empty.tif", "")).describe(), folder.file("empty.tif") + ": is empty");
  EXPECT_TRUE(contains(demErrorOf(folder.file("")).message, "folder"));
  EXPECT_EQ(demErrorOf("").code, ErrorCode::usage);
  EXPECT_EQ(demErrorOf(folder.write("prose.doc", "once upon a time")).code, ErrorCode::unsupported);
  EXPECT_EQ(demErrorOf(folder.write("damaged.tif", std::string("II*\0\xff\xff\xff\x7f", 8))).code,
            ErrorCode::corrupt);
  EXPECT_EQ(GetCapturedStderr(), "");
}

TEST(DemReader, ReadsARealRasterAndRefusesARealCloud) {
  const std::string raster = test::realData("dem/srtm3_N43E007_nice.hgt.zip");
  const std::string cloud = test::realData("points/autzen_trim.las");
  const std::string polygons = test::realData("drape/zion_boundary.gpkg");
  if (raster.empty() || cloud.empty() || polygons.empty())
    GTEST_SKIP() << "the real data is not here; ARETE_DATA names its folder";
  EXPECT_EQ(std::get<RasterHeightfield>(demOrFail(raster).heightfield).columns, 1201u);
  EXPECT_EQ(demErrorOf(cloud).code, ErrorCode::unsupported);
  EXPECT_TRUE(contains(demErrorOf(polygons).message, "no layer of points"))
      << demErrorOf(polygons).describe();
}

}  // namespace
}  // namespace arete
