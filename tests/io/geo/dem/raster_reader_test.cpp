// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/dem/raster_reader.h"

#include <cpl_string.h>
#include <cpl_vsi.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/io_fixture.h"

namespace arete {
namespace {

using test::contains;
using test::joined;
using test::RasterSpec;
using test::TemporaryFolder;
using test::writeRaster;
using ::testing::internal::CaptureStderr;
using ::testing::internal::GetCapturedStderr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

RasterHeightfield readRasterOrFail(const std::string& path, const RasterReadOptions& options = {},
                                   Warnings* warnings = nullptr) {
  auto read = readRaster(path, options);
  if (!read) {
    ADD_FAILURE() << read.error().describe();
    return {};
  }
  if (warnings) *warnings = read->warnings;
  return std::move(read->heightfield);
}

Error rasterErrorOf(const std::string& path, const RasterReadOptions& options = {}) {
  auto read = readRaster(path, options);
  if (read) ADD_FAILURE() << path << " was read";
  return read ? Error{} : read.error();
}

void expectHeights(const RasterHeightfield& heightfield, const std::vector<double>& expected) {
  ASSERT_EQ(heightfield.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (std::isnan(expected[i]))
      EXPECT_TRUE(std::isnan(heightfield.heights[i])) << "sample " << i << " is " << heightfield.heights[i];
    else
      EXPECT_EQ(heightfield.heights[i], expected[i]) << "sample " << i;
  }
}

RasterReadOptions withBand(int band) {
  RasterReadOptions options;
  options.band = band;
  return options;
}

TEST(RasterReader, ReadsEveryRealSampleType) {
  TemporaryFolder folder;
  for (const GDALDataType type : {GDT_Byte, GDT_UInt16, GDT_Int16, GDT_UInt32, GDT_Int32, GDT_UInt64,
                                  GDT_Int64, GDT_Float32, GDT_Float64}) {
    RasterSpec spec;
    spec.type = type;
    const std::string path = writeRaster(folder.file(std::string(GDALGetDataTypeName(type)) + ".tif"), spec);
    SCOPED_TRACE(path);
    const RasterHeightfield read = readRasterOrFail(path);
    EXPECT_EQ(read.columns, 3u);
    EXPECT_EQ(read.rows, 2u);
    expectHeights(read, {1, 2, 3, 4, 5, 6});
    EXPECT_EQ(read.source, path);
    EXPECT_EQ(read.sourceChecksum, heightsChecksum(read));
  }
}

TEST(RasterReader, KeepsTheFullRangeOfWideTypes) {
  TemporaryFolder folder;
  RasterSpec spec;
  spec.type = GDT_UInt32;
  spec.values = {0, 4294967295.0, 1, 2, 3, 4};
  expectHeights(readRasterOrFail(writeRaster(folder.file("u32.tif"), spec)), spec.values);
  spec.type = GDT_Int32;
  spec.values = {-2147483648.0, 2147483647, 1, 2, 3, 4};
  expectHeights(readRasterOrFail(writeRaster(folder.file("i32.tif"), spec)), spec.values);
  spec.type = GDT_Float64;
  spec.values = {0.1, 1e-300, -12345.678901234567, 2, 3, 4};
  expectHeights(readRasterOrFail(writeRaster(folder.file("f64.tif"), spec)), spec.values);
}

TEST(RasterReader, ReadsSignedBytes) {
  TemporaryFolder folder;
  RasterSpec spec;
  spec.type = GDT_Byte;
  spec.values = {0, 127, 128, 255, 5, 6};
  spec.options = {"PIXELTYPE=SIGNEDBYTE"};
  const std::string path = writeRaster(folder.file("i8.tif"), spec);
  expectHeights(readRasterOrFail(path), {0, 127, -128, -1, 5, 6});
}

TEST(RasterReader, RefusesComplexSamples) {
  TemporaryFolder folder;
  RasterSpec spec;
  spec.type = GDT_CFloat32;
  const Error error = rasterErrorOf(writeRaster(folder.file("complex.tif"), spec));
  EXPECT_EQ(error.code, ErrorCode::unsupported);
  EXPECT_TRUE(contains(error.message, "complex")) << error.describe();
}

TEST(RasterReader, RefusesA64BitHeightADoubleCannotHold) {
  TemporaryFolder folder;
  RasterSpec spec;
  spec.type = GDT_Int64;
  spec.values = {1, 2, 3, 4, 36028797018963968.0, 6};
  const Error error = rasterErrorOf(writeRaster(folder.file("i64.tif"), spec));
  EXPECT_EQ(error.code, ErrorCode::invalidData);
  EXPECT_TRUE(contains(error.message, "column 1, row 1")) << error.describe();
}

TEST(RasterReader, TakesTheDeclaredNodataOfEveryTypeOut) {
  TemporaryFolder folder;
  for (const GDALDataType type : {GDT_Byte, GDT_Int16, GDT_Int32, GDT_Float32, GDT_Float64}) {
    RasterSpec spec;
    spec.type = type;
    spec.adjust = [](GDALDataset& d) { d.GetRasterBand(1)->SetNoDataValue(4); };
    SCOPED_TRACE(GDALGetDataTypeName(type));
    expectHeights(readRasterOrFail(writeRaster(folder.file("nodata.tif"), spec)), {1, 2, 3, kNan, 5, 6});
  }
  RasterSpec wide;
  wide.type = GDT_Int64;
  wide.adjust = [](GDALDataset& d) { d.GetRasterBand(1)->SetNoDataValueAsInt64(4); };
  expectHeights(readRasterOrFail(writeRaster(folder.file("wide.tif"), wide)), {1, 2, 3, kNan, 5, 6});
  wide.type = GDT_UInt64;
  wide.adjust = [](GDALDataset& d) { d.GetRasterBand(1)->SetNoDataValueAsUInt64(4); };
  expectHeights(readRasterOrFail(writeRaster(folder.file("uwide.tif"), wide)), {1, 2, 3, kNan, 5, 6});
}

TEST(RasterReader, ComparesNodataOfFloatsAsFloats) {
  TemporaryFolder folder;
  RasterSpec spec;
  spec.type = GDT_Float32;
  spec.values = {1.1, 2, -3.4028234663852886e38, 4, 5, 6};
  spec.adjust = [](GDALDataset& d) { d.GetRasterBand(1)->SetNoDataValue(1.1); };
  Warnings warnings;
  const RasterHeightfield read = readRasterOrFail(writeRaster(folder.file("f.tif"), spec), {}, &warnings);
  EXPECT_TRUE(std::isnan(read.heights[0]));
  EXPECT_TRUE(contains(joined(warnings), "undeclared NODATA")) << joined(warnings);

  // A value beyond any height, its text cut off, means the same value still.
  RasterReadOptions options;
  options.nodata = -3.40282e38;
  warnings.clear();
  const RasterHeightfield stated = readRasterOrFail(folder.file("f.tif"), options, &warnings);
  EXPECT_TRUE(std::isnan(stated.heights[2]));
  EXPECT_EQ(stated.heights[0], double(1.1f)) << "the stated value replaces the declared one";
  EXPECT_TRUE(warnings.empty()) << joined(warnings);
}

TEST(RasterReader, TakesNanAndInfinityForNodata) {
  TemporaryFolder folder;
  RasterSpec spec;
  spec.type = GDT_Float32;
  const double inf = std::numeric_limits<double>::infinity();
  spec.values = {kNan, 2, inf, -inf, 5, 6};
  spec.adjust = [](GDALDataset& d) { d.GetRasterBand(1)->SetNoDataValue(std::nan("")); };
  Warnings warnings;
  expectHeights(readRasterOrFail(writeRaster(folder.file("inf.tif"), spec), {}, &warnings),
                {kNan, 2, kNan, kNan, 5, 6});
  EXPECT_TRUE(contains(joined(warnings), "2 infinite heights")) << joined(warnings);
}

TEST(RasterReader, TakesNothingElseOutWhereNodataIsInfinite) {
  TemporaryFolder folder;
  const double inf = std::numeric_limits<double>::infinity();
  for (const double nodata : {inf, -inf})
    for (const GDALDataType type : {GDT_Float32, GDT_Float64, GDT_Int16}) {
      RasterSpec spec;
      spec.type = type;
      spec.values = {1, 2, 3, 4, 5, type == GDT_Int16 ? 6 : nodata};
      const double last = type == GDT_Int16 ? 6 : kNan;
      spec.adjust = [&](GDALDataset& d) { d.GetRasterBand(1)->SetNoDataValue(nodata); };
      Warnings warnings;
      expectHeights(readRasterOrFail(writeRaster(folder.file("declared.tif"), spec), {}, &warnings),
                    {1, 2, 3, 4, 5, last});
      EXPECT_TRUE(warnings.empty()) << joined(warnings);
      spec.adjust = {};
      RasterReadOptions stated;
      stated.nodata = nodata;
      expectHeights(readRasterOrFail(writeRaster(folder.file("stated.tif"), spec), stated, &warnings),
                    {1, 2, 3, 4, 5, last});
      EXPECT_TRUE(warnings.empty()) << joined(warnings);
    }
}

TEST(RasterReader, AppliesAMaskOfTheDataset) {
  TemporaryFolder folder;
  RasterSpec spec;
  const std::string path = writeRaster(folder.file("mask.tif"), spec);
  {
    GDALDataset* dataset = GDALDataset::Open(path.c_str(), GDAL_OF_UPDATE | GDAL_OF_RASTER);
    ASSERT_NE(dataset, nullptr);
    ASSERT_EQ(dataset->CreateMaskBand(GMF_PER_DATASET), CE_None);
    std::vector<unsigned char> mask = {255, 0, 255, 255, 255, 0};
    ASSERT_EQ(dataset->GetRasterBand(1)->GetMaskBand()->RasterIO(GF_Write, 0, 0, 3, 2, mask.data(), 3, 2,
                                                                 GDT_Byte, 0, 0, nullptr),
              CE_None);
    GDALClose(GDALDataset::ToHandle(dataset));
  }
  expectHeights(readRasterOrFail(path), {1, kNan, 3, 4, 5, kNan});
}

TEST(RasterReader, AppliesAnAlphaBand) {
  TemporaryFolder folder;
  RasterSpec spec;
  spec.type = GDT_UInt16;
  spec.bands = 2;
  spec.values = {1, 0, 3, 4, 5, 6};
  spec.adjust = [](GDALDataset& d) { d.GetRasterBand(2)->SetColorInterpretation(GCI_AlphaBand); };
  expectHeights(readRasterOrFail(writeRaster(folder.file("alpha.tif"), spec)), {1, kNan, 3, 4, 5, 6});
}

TEST(RasterReader, AppliesScaleAndOffsetAfterNodata) {
  TemporaryFolder folder;
  RasterSpec spec;
  spec.adjust = [](GDALDataset& d) {
    d.GetRasterBand(1)->SetScale(0.5);
    d.GetRasterBand(1)->SetOffset(100);
    d.GetRasterBand(1)->SetNoDataValue(2);
  };
  const RasterHeightfield read = readRasterOrFail(writeRaster(folder.file("scaled.tif"), spec));
  expectHeights(read, {100.5, kNan, 101.5, 102, 102.5, 103});
  EXPECT_EQ(read.rawScale, 0.5);
  EXPECT_EQ(read.rawOffset, 100);
}

TEST(RasterReader, KeepsRotatedAndSouthUpAndOblongGrids) {
  TemporaryFolder folder;
  for (const std::array<double, 6>& transform : {std::array<double, 6>{500000, 30, 0, 4000000, 0, 30},
                                                 std::array<double, 6>{500000, 30, 5, 4000000, 7, -30},
                                                 std::array<double, 6>{500000, 30, 0, 4000000, 0, -90}}) {
    RasterSpec spec;
    spec.geoTransform = transform;
    const RasterHeightfield read = readRasterOrFail(writeRaster(folder.file("grid.tif"), spec));
    EXPECT_TRUE(read.georeference.hasGeoTransform);
    EXPECT_EQ(read.georeference.geoTransform, transform);
    expectHeights(read, {1, 2, 3, 4, 5, 6});
    const Vec2 source = read.georeference.toSource(2, 1), grid = read.georeference.toGrid(source.x, source.y);
    EXPECT_NEAR(grid.x, 2, 1e-9);
    EXPECT_NEAR(grid.y, 1, 1e-9);
  }
}

TEST(RasterReader, PlacesThePictureOfATerrainWithItsFirstRowInTheNorth) {
  TemporaryFolder folder;
  RasterSpec spec;
  spec.geoTransform.reset();
  spec.crs.clear();
  Warnings warnings;
  for (const char* crs : {"", "EPSG:4326"}) {
    spec.crs = crs;
    warnings.clear();
    const RasterHeightfield read =
        readRasterOrFail(writeRaster(folder.file("bare.tif"), spec), {}, &warnings);
    EXPECT_FALSE(read.georeference.hasGeoTransform);
    EXPECT_EQ(read.georeference.geoTransform, (std::array<double, 6>{0, 1, 0, 2, 0, -1}));
    EXPECT_LT(read.georeference.determinant(), 0) << "mirrored";
    EXPECT_TRUE(read.georeference.crsWkt.empty()) << "columns are no degrees";
    EXPECT_TRUE(contains(joined(warnings), "has no georeference")) << joined(warnings);
  }
}

TEST(RasterReader, RefusesAGeotransformWithoutInverse) {
  TemporaryFolder folder;
  const std::string path = folder.write(
      "flat.vrt",
      "<VRTDataset rasterXSize=\"2\" rasterYSize=\"2\"><GeoTransform>0, 1, 1, 0, 1, 1</GeoTransform>"
      "<VRTRasterBand dataType=\"Float32\" band=\"1\"/></VRTDataset>");
  EXPECT_EQ(rasterErrorOf(path).code, ErrorCode::invalidData);
}

TEST(RasterReader, DescribesProjectedGeographicAndLocalFrames) {
  TemporaryFolder folder;
  RasterSpec spec;
  spec.crs = "EPSG:2263";  // New York, US survey feet
  Georeference g = readRasterOrFail(writeRaster(folder.file("feet.tif"), spec)).georeference;
  EXPECT_FALSE(g.isGeographic);
  EXPECT_NEAR(g.linearUnitMetres, 1200.0 / 3937.0, 1e-12);
  EXPECT_NEAR(g.inverseFlattening, 298.257222101, 1e-9);
  EXPECT_TRUE(g.verticalUnit.empty());
  EXPECT_EQ(g.crsWkt.substr(0, 7), "PROJCRS");

  spec.crs = "EPSG:4807";  // NTF (Paris), grads
  g = readRasterOrFail(writeRaster(folder.file("grad.tif"), spec)).georeference;
  EXPECT_TRUE(g.isGeographic);
  EXPECT_NEAR(g.angularUnitRadians, std::acos(-1.0) / 200, 1e-15);
  EXPECT_NEAR(g.semiMajorAxisMetres, 6378249.2, 0.01);

  spec.crs = "LOCAL_CS[\"quarry\",UNIT[\"foot\",0.3048]]";
  g = readRasterOrFail(writeRaster(folder.file("local.img"),
                                   [&] {
                                     RasterSpec hfa = spec;
                                     hfa.driver = "HFA";
                                     return hfa;
                                   }()))
          .georeference;
  EXPECT_FALSE(g.isGeographic);
}

TEST(RasterReader, TakesHeightUnitAndDatumFromACompoundCrs) {
  TemporaryFolder folder;
  RasterSpec spec;
  spec.crs = "EPSG:2263+6360";  // NAVD88 height (ftUS)
  Georeference g = readRasterOrFail(writeRaster(folder.file("ftus.tif"), spec)).georeference;
  EXPECT_NEAR(g.verticalUnitMetres, 1200.0 / 3937.0, 1e-12) << g.verticalUnit;
  EXPECT_TRUE(contains(g.verticalDatum, "NAVD88")) << g.verticalDatum;
  EXPECT_NEAR(g.linearUnitMetres, 1200.0 / 3937.0, 1e-12);

  spec.crs = "EPSG:2263";
  RasterReadOptions options;
  options.crs = "EPSG:2263+5703";  // NAVD88 height in metres over feet in the plan
  Warnings warnings;
  g = readRasterOrFail(writeRaster(folder.file("m.tif"), spec), options, &warnings).georeference;
  EXPECT_EQ(g.verticalUnitMetres, 1);
  EXPECT_NEAR(g.linearUnitMetres, 1200.0 / 3937.0, 1e-12);
  EXPECT_TRUE(contains(joined(warnings), "replaced")) << joined(warnings);
}

TEST(RasterReader, PrefersTheUnitOfTheBand) {
  TemporaryFolder folder;
  RasterSpec spec;
  for (const auto& [name, metres] : std::map<std::string, double>{
           {"ft", 0.3048}, {"US survey foot", 1200.0 / 3937.0}, {"metre", 1}, {"M", 1}, {"cm", 0.01}}) {
    spec.adjust = [&name = name](GDALDataset& d) { d.GetRasterBand(1)->SetUnitType(name.c_str()); };
    const Georeference g = readRasterOrFail(writeRaster(folder.file("unit.tif"), spec)).georeference;
    EXPECT_EQ(g.verticalUnit, name);
    EXPECT_NEAR(g.verticalUnitMetres, metres, 1e-15);
  }
  spec.adjust = [](GDALDataset& d) { d.GetRasterBand(1)->SetUnitType("smoots"); };
  Warnings warnings;
  EXPECT_EQ(readRasterOrFail(writeRaster(folder.file("unit.tif"), spec), {}, &warnings)
                .georeference.verticalUnitMetres,
            1);
  EXPECT_TRUE(contains(joined(warnings), "smoots"));
}

TEST(RasterReader, UsesTheStatedCrsWhereTheFileHasNone) {
  TemporaryFolder folder;
  RasterSpec spec;
  spec.crs.clear();
  const std::string path = writeRaster(folder.file("none.tif"), spec);
  RasterReadOptions options;
  options.crs = "EPSG:4326";
  Warnings warnings;
  EXPECT_TRUE(readRasterOrFail(path, options, &warnings).georeference.isGeographic);
  EXPECT_TRUE(warnings.empty()) << joined(warnings);
  options.crs = "EPSG:notacode";
  const Error error = rasterErrorOf(path, options);
  EXPECT_EQ(error.code, ErrorCode::usage);
  EXPECT_EQ(error.culprit, "EPSG:notacode");
}

TEST(RasterReader, NamesTheBandsThereAre) {
  TemporaryFolder folder;
  RasterSpec spec;
  spec.bands = 3;
  const std::string path = writeRaster(folder.file("bands.tif"), spec);
  for (const int band : {0, -1, 4}) {
    const Error error = rasterErrorOf(path, withBand(band));
    EXPECT_EQ(error.code, ErrorCode::usage);
    EXPECT_TRUE(contains(error.message, "3 bands")) << error.describe();
  }
  Warnings warnings;
  readRasterOrFail(path, {}, &warnings);
  EXPECT_TRUE(contains(joined(warnings), "3 bands")) << joined(warnings);
  readRasterOrFail(path, withBand(3), &warnings);
}

TEST(RasterReader, RefusesAColourImageUnlessABandIsNamed) {
  TemporaryFolder folder;
  RasterSpec spec;
  spec.bands = 3;
  spec.type = GDT_Byte;
  const std::string path = writeRaster(folder.file("image.tif"), spec);
  const Error error = rasterErrorOf(path);
  EXPECT_EQ(error.code, ErrorCode::unsupported);
  EXPECT_TRUE(contains(error.message, "`band`")) << error.describe();
  expectHeights(readRasterOrFail(path, withBand(2)), {1, 2, 3, 4, 5, 6});
}

TEST(RasterReader, ListsSubdatasets) {
  TemporaryFolder folder;
  RasterSpec spec;
  const std::string a = writeRaster(folder.file("a.tif"), spec);
  const std::string path = folder.file("two.gpkg");
  for (const char* table : {"north", "south"}) {
    GDALDataset* source = GDALDataset::Open(a.c_str());
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GPKG");
    CPLStringList list;
    list.SetNameValue("RASTER_TABLE", table);
    list.SetNameValue("APPEND_SUBDATASET", "YES");
    GDALDataset* written = driver->CreateCopy(path.c_str(), source, false, list.List(), nullptr, nullptr);
    ASSERT_NE(written, nullptr);
    GDALClose(GDALDataset::ToHandle(written));
    GDALClose(GDALDataset::ToHandle(source));
  }
  const Error error = rasterErrorOf(path);
  EXPECT_EQ(error.code, ErrorCode::unsupported);
  EXPECT_TRUE(contains(error.message, "north") && contains(error.message, "south")) << error.describe();
  EXPECT_EQ(readRasterOrFail("GPKG:" + path + ":south").columns, 3u);
}

TEST(RasterReader, FindsTheOneRasterInAZip) {
  TemporaryFolder folder;
  RasterSpec spec;
  const std::string inner = writeRaster(folder.file("inner.tif"), spec);
  const auto add = [&](const std::string& zip, const std::string& name) {
    VSILFILE* out = VSIFOpenL(("/vsizip/" + folder.file(zip) + "/" + name).c_str(), "wb");
    std::ifstream in(inner, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    VSIFWriteL(bytes.data(), 1, bytes.size(), out);
    VSIFCloseL(out);
  };
  add("one.zip", "folder/dem.tif");
  const RasterHeightfield read = readRasterOrFail(folder.file("one.zip"));
  expectHeights(read, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(read.source, folder.file("one.zip"));
  expectHeights(readRasterOrFail("/vsizip/" + folder.file("one.zip") + "/folder/dem.tif"),
                {1, 2, 3, 4, 5, 6});

  add("two.zip", "a.tif");
  {
    // GDAL cannot append to an archive it has closed; two members are written in one go.
    VSIUnlink(folder.file("two.zip").c_str());
    const std::string root = "/vsizip/" + folder.file("two.zip");
    VSILFILE* archive = VSIFOpenL(root.c_str(), "wb");
    add("two.zip", "a.tif");
    add("two.zip", "b.tif");
    VSIFCloseL(archive);
  }
  const Error error = rasterErrorOf(folder.file("two.zip"));
  EXPECT_EQ(error.code, ErrorCode::unsupported);
  EXPECT_TRUE(contains(error.message, "a.tif, b.tif")) << error.describe();
  EXPECT_EQ(rasterErrorOf(folder.write("not.zip", "this is no archive")).code, ErrorCode::corrupt);
  EXPECT_EQ(rasterErrorOf(folder.file("absent.zip")).code, ErrorCode::notFound);
}

TEST(RasterReader, SaysWhyAFileCannotBeRead) {
  TemporaryFolder folder;
  EXPECT_EQ(rasterErrorOf(folder.file("absent.tif")).code, ErrorCode::notFound);
  EXPECT_EQ(rasterErrorOf(folder.write("empty.tif", "")).describe(), folder.file("empty.tif") + ": is empty");
  EXPECT_TRUE(contains(rasterErrorOf(folder.file("")).message, "folder"));
  EXPECT_EQ(rasterErrorOf(folder.write("prose.tif", "no raster at all")).code, ErrorCode::unsupported);
  EXPECT_EQ(rasterErrorOf(folder.write("damaged.tif", std::string("II*\0\xff\xff\xff\x7f", 8))).code,
            ErrorCode::corrupt);
}

TEST(RasterReader, SaysThatAFileIsCutShortAndPrintsNothing) {
  TemporaryFolder folder;
  RasterSpec spec;
  spec.columns = 200;
  spec.rows = 200;
  spec.values.assign(40000, 7);
  const std::string path = writeRaster(folder.file("cut.tif"), spec);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  CaptureStderr();
  const Error error = rasterErrorOf(path);
  EXPECT_EQ(GetCapturedStderr(), "");
  EXPECT_TRUE(error.code == ErrorCode::unreadable || error.code == ErrorCode::corrupt) << error.describe();
  EXPECT_EQ(error.culprit, path);
}

TEST(RasterReader, RefusesMoreSamplesThanCanBeNumbered) {
  TemporaryFolder folder;
  const std::string path =
      folder.write("huge.vrt",
                   "<VRTDataset rasterXSize=\"70000\" rasterYSize=\"70000\"><VRTRasterBand dataType=\"Byte\" "
                   "band=\"1\"/></VRTDataset>");
  const Error error = rasterErrorOf(path);
  EXPECT_EQ(error.code, ErrorCode::unsupported);
  EXPECT_TRUE(contains(error.message, "70000 columns")) << error.describe();
}

TEST(RasterReader, TellsItsProgressAndStopsWhenAsked) {
  TemporaryFolder folder;
  RasterSpec spec;
  spec.columns = 1000;
  spec.rows = 3000;
  spec.values.assign(3000000, 7);
  const std::string path = writeRaster(folder.file("long.tif"), spec);
  std::vector<double> fractions;
  std::atomic<bool> cancel = false;
  RunContext context;
  context.progress = [&](std::string_view, double fraction) { fractions.push_back(fraction); };
  ASSERT_TRUE(readRaster(path, {}, context));
  EXPECT_GE(fractions.size(), 3u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1);

  context.cancel = &cancel;
  context.progress = [&](std::string_view, double) { cancel = true; };
  const auto stopped = readRaster(path, {}, context);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::interrupted);
}

TEST(RasterReader, ReadsAnAsciiGridAndAVirtualRaster) {
  TemporaryFolder folder;
  const std::string grid = folder.write(
      "grid.asc",
      "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 5\nNODATA_value -9999\n1.5 2 3\n4 -9999 6\n");
  const RasterHeightfield read = readRasterOrFail(grid);
  expectHeights(read, {1.5, 2, 3, 4, kNan, 6});
  EXPECT_EQ(read.georeference.geoTransform, (std::array<double, 6>{10, 5, 0, 30, 0, -5}));

  const std::string vrt = folder.write(
      "grid.vrt",
      "<VRTDataset rasterXSize=\"3\" rasterYSize=\"2\"><VRTRasterBand dataType=\"Float32\" band=\"1\">"
      "<NoDataValue>-9999</NoDataValue><SimpleSource><SourceFilename "
      "relativeToVRT=\"1\">grid.asc</SourceFilename>"
      "<SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>");
  expectHeights(readRasterOrFail(vrt), {1.5, 2, 3, 4, kNan, 6});
}

}  // namespace
}  // namespace arete
