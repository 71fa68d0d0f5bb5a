// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/point_reader.h"

#include <cpl_vsi.h>
#include <fmt/format.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>

#include "io/dem_reader.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

using test::TemporaryFolder;
using ::testing::internal::CaptureStderr;
using ::testing::internal::GetCapturedStderr;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string joined(const std::vector<std::string>& warnings) {
  std::string all;
  for (const std::string& warning : warnings) all += warning + "\n";
  return all;
}

PointRead readOrFail(const std::string& path, const PointReadOptions& options = {}) {
  auto read = readPoints(path, options);
  if (!read) {
    ADD_FAILURE() << read.error().describe();
    return {};
  }
  return std::move(*read);
}

Error errorOf(const std::string& path, const PointReadOptions& options = {}) {
  auto read = readPoints(path, options);
  if (read) ADD_FAILURE() << path << " was read";
  return read ? Error{} : read.error();
}

/// Three points: (1, 2, 3.5), (-4, 5e2, 6), (7, 8, 0.1).
void expectTheThree(const PointRead& read) {
  const PointHeightfield& points = read.heightfield;
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points.positions, (std::vector<Vec2>{{1, 2}, {-4, 500}, {7, 8}}));
  EXPECT_EQ(points.heights, (std::vector<double>{3.5, 6, 0.1}));
}

TEST(PointText, ReadsEverySeparator) {
  TemporaryFolder folder;
  for (const char* text :
       {"1,2,3.5\n-4,5e2,6\n7,8,0.1\n", "1;2;3.5\n-4;5e2;6\n7;8;0.1\n", "1\t2\t3.5\n-4\t5e2\t6\n7\t8\t0.1\n",
        "1 2 3.5\n  -4   5e2 6 \n7 8 0.1\n", "1, 2, 3.5\n-4, +5e2, 6\n7, 8, 0.1",
        "1,2,3.5,ground\r\n-4,5e2,6,x,y\r\n7,8,0.1,\r\n",
        "\xEF\xBB\xBF# a comment, with commas\n\n1 2 3.5 # and more\n-4 5e2 6\n   \n7 8 .1\n"}) {
    SCOPED_TRACE(text);
    const PointRead read = readOrFail(folder.write("points.txt", text));
    expectTheThree(read);
    EXPECT_TRUE(read.warnings.empty()) << joined(read.warnings);
  }
}

TEST(PointText, FindsColumnsByName) {
  TemporaryFolder folder;
  for (const char* text :
       {"x,y,z\n1,2,3.5\n-4,5e2,6\n7,8,0.1\n", "id;Lat;LON;Elevation\na;2;1;3.5\nb;5e2;-4;6\nc;8;7;0.1\n",
        "\"height\",\"easting\",\"northing\"\n\"3.5\",1,2\n6,\"-4\",5e2\n0.1,7,8\n",
        "name,X,Y,Z\n\"a, b\",1,2,3.5\nc,-4,5e2,6\nd,7,8,0.1\n", "X Y Z\n1 2 3.5\n-4 5e2 6\n7 8 0.1\n"}) {
    SCOPED_TRACE(text);
    expectTheThree(readOrFail(folder.write("points.csv", text)));
  }
  const PointRead unnamed = readOrFail(folder.write("points.csv", "a,b,c\n1,2,3.5\n-4,5e2,6\n7,8,0.1\n"));
  expectTheThree(unnamed);
  EXPECT_TRUE(contains(joined(unnamed.warnings), "a, b, c")) << joined(unnamed.warnings);
}

TEST(PointText, TakesTheHeightFromTheColumnStated) {
  TemporaryFolder folder;
  const std::string path = folder.write("points.csv", "x,y,z,Depth\n1,2,0,3.5\n-4,5e2,0,6\n7,8,0,0.1\n");
  PointReadOptions options;
  options.zField = "depth";
  expectTheThree(readOrFail(path, options));
  options.zField = "width";
  const Error error = errorOf(path, options);
  EXPECT_EQ(error.code, ErrorCode::usage);
  EXPECT_TRUE(contains(error.message, "x, y, z, Depth")) << error.describe();
  EXPECT_EQ(errorOf(folder.write("headless.csv", "1,2,3\n"), options).code, ErrorCode::usage);
}

TEST(PointText, NamesFileLineAndTextOfAnError) {
  TemporaryFolder folder;
  struct Case {
    const char* text;
    int line;
    const char* offending;
  };
  for (const Case& c : {Case{"1,2,3\n4,five,6\n", 2, "'five'"}, Case{"x,y,z\n1,2,3\n4,5\n", 3, "'4,5'"},
                        Case{"1,2,3\n\n# no\n4,5,nan\n", 4, "'nan'"}, Case{"1,2,inf\n", 1, "'inf'"},
                        Case{"1,2,1e999\n", 1, "'1e999'"}, Case{"1;2;3\n1;2;3,5\n", 2, "'3,5'"},
                        Case{"1,2,3m\n", 1, "'3m'"}, Case{"1,2,\n", 1, "''"}}) {
    const std::string path = folder.write("bad.csv", c.text);
    const Error error = errorOf(path);
    EXPECT_EQ(error.code, ErrorCode::invalidData);
    EXPECT_EQ(error.culprit, fmt::format("{}:{}", path, c.line));
    EXPECT_TRUE(contains(error.message, c.offending)) << error.describe();
  }
  EXPECT_TRUE(contains(errorOf(folder.write("bad.csv", "1,2,\x1b[2J3\n")).message, "'?[2J3'"))
      << "no file talks to a terminal";
  const Error noHeight = errorOf(folder.write("bad.csv", "x,y,colour\n1,2,3\n"));
  EXPECT_TRUE(contains(noHeight.message, "x, y, colour")) << noHeight.describe();
  EXPECT_EQ(errorOf(folder.write("none.csv", "x,y,z\n")).code, ErrorCode::invalidData);
}

TEST(PointText, RoundsNumbersThatLeaveTheRangeOfDoubles) {
  TemporaryFolder folder;
  const std::string zeros(400, '0');
  const std::string text = "1e-400,0." + zeros + "1,1" + zeros + "e-399\n2,-1e-999,3\n7,8,9\n";
  const PointRead read = readOrFail(folder.write("points.csv", text));
  EXPECT_EQ(read.heightfield.positions, (std::vector<Vec2>{{0, 0}, {2, 0}, {7, 8}}));
  EXPECT_EQ(read.heightfield.heights, (std::vector<double>{10, 3, 9}));
  const Error error = errorOf(folder.write("points.csv", "1,2,1" + zeros + "e-50\n"));
  EXPECT_TRUE(contains(error.message, "is not a finite number")) << error.describe();
}

TEST(PointText, NamesAFewOfManyColumns) {
  TemporaryFolder folder;
  std::string text = "x,y";
  for (int i = 0; i < 5000; ++i) text += fmt::format(",column {}", i);
  const Error error = errorOf(folder.write("points.csv", text + "\n1,2\n"));
  EXPECT_TRUE(contains(error.message, "column 17 and 4982 more")) << error.describe();
}

TEST(PointText, ReadsLinesAcrossChunks) {
  TemporaryFolder folder;
  std::string text;
  const int count = 400000;
  for (int i = 0; i < count; ++i) text += fmt::format("{}.25 {} {}\n", i % 1000, i / 1000, i * 0.5);
  std::vector<double> fractions;
  RunContext context;
  context.progress = [&](std::string_view, double fraction) { fractions.push_back(fraction); };
  const auto read = readPoints(folder.write("many.xyz", text), {}, context);
  ASSERT_TRUE(read) << read.error().describe();
  ASSERT_EQ(read->heightfield.size(), std::size_t(count));
  for (int i = 0; i < count; ++i) {
    ASSERT_EQ(read->heightfield.positions[std::size_t(i)], (Vec2{i % 1000 + 0.25, double(i / 1000)}));
    ASSERT_EQ(read->heightfield.heights[std::size_t(i)], i * 0.5);
  }
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  std::atomic<bool> cancel = true;
  context.cancel = &cancel;
  EXPECT_EQ(readPoints(folder.file("many.xyz"), {}, context).error().code, ErrorCode::interrupted);
}

TEST(PointReader, MergesEqualPointsAndCountsThem) {
  TemporaryFolder folder;
  const PointRead read =
      readOrFail(folder.write("twice.csv", "1,2,3\n4,5,6\n1,2,3\n0,0,0\n-0,0,-0\n1.0,2.0,3.0\n"));
  EXPECT_EQ(read.heightfield.positions, (std::vector<Vec2>{{1, 2}, {4, 5}, {0, 0}}));
  EXPECT_TRUE(contains(joined(read.warnings), "3 points repeat")) << joined(read.warnings);
}

TEST(PointReader, NamesTwoPointsOfOnePlaceAndDifferentHeight) {
  TemporaryFolder folder;
  const Error error = errorOf(folder.write("fold.csv", "x,y,z\n1,2,3\n4,5,6\n\n9,9,9\n4,5,6.5\n9,9,8\n"));
  EXPECT_EQ(error.code, ErrorCode::degenerate);
  EXPECT_TRUE(contains(error.message, "line 3") && contains(error.message, "line 6")) << error.describe();
}

TEST(PointReader, LeavesNodataPointsOut) {
  TemporaryFolder folder;
  PointReadOptions options;
  options.nodata = -9999;
  const PointRead read =
      readOrFail(folder.write("voids.csv", "1,2,3.5\n0,0,-9999\n-4,500,6\n7,8,0.1\n"), options);
  expectTheThree(read);
  EXPECT_TRUE(contains(joined(read.warnings), "1 points of the height -9999")) << joined(read.warnings);
}

TEST(PointReader, GivesGridCoordinatesThatEqualSourceCoordinates) {
  TemporaryFolder folder;
  PointReadOptions options;
  options.crs = "EPSG:28992+5709";
  const Georeference g =
      readOrFail(folder.write("p.csv", "85000,447412.8,1\n2,3,4\n5,7,6\n"), options).heightfield.georeference;
  EXPECT_EQ(g.toGrid(85000, 447412.75), (Vec2{85000, 447412.75}));
  EXPECT_EQ(g.toSource(3, 4), (Vec2{3, 4}));
  EXPECT_FALSE(g.isGeographic);
  EXPECT_EQ(g.verticalDatum, "NAP height");
  EXPECT_EQ(g.verticalUnitMetres, 1);
}

struct LayerSpec {
  const char* name;
  OGRwkbGeometryType type;
  std::vector<std::pair<const char*, double>> features;  ///< WKT (or null), and the field "h"
};

std::string writeVector(const std::string& path, const char* driverName, const std::vector<LayerSpec>& layers,
                        const char* crsName = "EPSG:32611") {
  GDALAllRegister();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(driverName);
  GDALDataset* dataset = driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr);
  OGRSpatialReference crs;
  if (crsName) crs.SetFromUserInput(crsName);
  for (const LayerSpec& spec : layers) {
    OGRLayer* layer = dataset->CreateLayer(spec.name, crsName ? &crs : nullptr, spec.type, nullptr);
    OGRFieldDefn height("h", OFTReal), label("label", OFTString);
    EXPECT_EQ(layer->CreateField(&height), OGRERR_NONE);
    EXPECT_EQ(layer->CreateField(&label), OGRERR_NONE);
    for (const auto& [wkt, h] : spec.features) {
      OGRFeatureUniquePtr feature(OGRFeature::CreateFeature(layer->GetLayerDefn()));
      if (wkt) {
        OGRGeometry* geometry = nullptr;
        OGRGeometryFactory::createFromWkt(wkt, nullptr, &geometry);
        feature->SetGeometryDirectly(geometry);
      }
      if (!std::isnan(h)) feature->SetField("h", h);
      EXPECT_EQ(layer->CreateFeature(feature.get()), OGRERR_NONE);
    }
  }
  GDALClose(GDALDataset::ToHandle(dataset));
  return path;
}

TEST(PointReader, ReadsPointsAndMultipointsWithZ) {
  TemporaryFolder folder;
  for (const auto& [file, driver] :
       std::map<std::string, const char*>{{"p.gpkg", "GPKG"}, {"p.geojson", "GeoJSON"}}) {
    const std::string path = writeVector(
        folder.file(file), driver,
        {{"points", wkbUnknown, {{"POINT Z (1 2 3.5)", 0}, {"MULTIPOINT Z ((-4 500 6),(7 8 0.1))", 0}}}});
    SCOPED_TRACE(path);
    const PointRead read = readOrFail(path);
    expectTheThree(read);
    EXPECT_FALSE(read.heightfield.georeference.crsWkt.empty());
  }
}

TEST(PointReader, TakesTheUndefinedCrsOfAGeoPackageForNone) {
  TemporaryFolder folder;
  const std::string path = writeVector(
      folder.file("p.gpkg"), "GPKG",
      {{"p", wkbPoint25D, {{"POINT Z (500000 5000000 1)", 0}, {"POINT Z (500009 5000000 2)", 0}}}}, nullptr);
  const PointRead plain = readOrFail(path);
  EXPECT_EQ(plain.heightfield.georeference.crsWkt, "");
  EXPECT_FALSE(plain.heightfield.georeference.isGeographic);
  PointReadOptions options;
  options.crs = "EPSG:32611";
  const PointRead stated = readOrFail(path, options);
  EXPECT_FALSE(stated.heightfield.georeference.crsWkt.empty());
  EXPECT_TRUE(stated.warnings.empty());  // nothing of the file's was replaced
}

TEST(PointReader, TakesTheHeightFromAField) {
  TemporaryFolder folder;
  const double null = std::numeric_limits<double>::quiet_NaN();
  const std::string path = writeVector(folder.file("p.gpkg"), "GPKG",
                                       {{"points",
                                         wkbPoint,
                                         {{"POINT (1 2)", 3.5},
                                          {"POINT (-4 500)", 6},
                                          {"POINT (0 0)", null},
                                          {nullptr, 1},
                                          {"POINT (7 8)", 0.1}}}});
  PointReadOptions options;
  options.zField = "h";
  const PointRead read = readOrFail(path, options);
  expectTheThree(read);
  EXPECT_TRUE(contains(joined(read.warnings), "2 features without")) << joined(read.warnings);
  const Error flat = errorOf(path);
  EXPECT_EQ(flat.code, ErrorCode::invalidData);
  EXPECT_TRUE(contains(flat.message, "--z-field") && contains(flat.message, "h, label")) << flat.describe();
  options.zField = "nothing";
  EXPECT_TRUE(contains(errorOf(path, options).message, "h, label"));
  options.zField = "label";
  EXPECT_EQ(errorOf(path, options).code, ErrorCode::usage);
}

TEST(PointReader, AsksWhichOfSeveralLayers) {
  TemporaryFolder folder;
  const std::string path = writeVector(folder.file("p.gpkg"), "GPKG",
                                       {{"peaks", wkbPoint25D, {{"POINT Z (1 2 3)", 0}}},
                                        {"wells", wkbPoint25D, {{"POINT Z (4 5 6)", 0}}},
                                        {"roads", wkbLineString, {{"LINESTRING (0 0,1 1)", 0}}}});
  const Error several = errorOf(path);
  EXPECT_EQ(several.code, ErrorCode::unsupported);
  EXPECT_TRUE(contains(several.message, "peaks, wells") && !contains(several.message, "roads"))
      << several.describe();
  PointReadOptions options;
  options.layer = "wells";
  EXPECT_EQ(readOrFail(path, options).heightfield.heights, std::vector<double>{6});
  options.layer = "lakes";
  EXPECT_EQ(errorOf(path, options).code, ErrorCode::notFound);
  options.layer = "roads";
  EXPECT_TRUE(contains(errorOf(path, options).message, "LINESTRING"));
  const std::string lines =
      writeVector(folder.file("l.gpkg"), "GPKG", {{"roads", wkbLineString, {{"LINESTRING (0 0,1 1)", 0}}}});
  EXPECT_TRUE(contains(errorOf(lines).message, "roads"));
}

TEST(PointReader, SaysWhyAFileCannotBeRead) {
  TemporaryFolder folder;
  EXPECT_EQ(errorOf(folder.file("absent.csv")).code, ErrorCode::notFound);
  EXPECT_EQ(errorOf(folder.file("absent.gpkg")).code, ErrorCode::notFound);
  EXPECT_EQ(errorOf(folder.write("empty.csv", "")).code, ErrorCode::unreadable);
  EXPECT_TRUE(contains(errorOf(folder.file("")).message, "folder"));
  EXPECT_EQ(errorOf(folder.write("prose.doc", "once upon a time")).code, ErrorCode::unsupported);
}

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

TEST(DemReader, WarnsOfPlacesThatLookLikeDegreesWithoutACrs) {
  TemporaryFolder folder;
  const auto isWarnedOf = [&](const std::string& name, const std::string& text, const std::string& crs = {}) {
    SourceReading reading;
    reading.crs = crs;
    std::string all;
    for (const std::string& warning : demOrFail(folder.write(name, text), reading).warnings) all += warning;
    return contains(all, "look like degrees");
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
