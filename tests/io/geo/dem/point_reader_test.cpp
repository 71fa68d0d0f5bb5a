// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/dem/point_reader.h"

#include <cpl_vsi.h>
#include <fmt/format.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>

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

TEST(PointText, ReadsWhatOtherProgramsWrite) {
  TemporaryFolder folder;
  const std::string utf8 = "x;y;z\n1;2;3,5\n-4;500;6\n7;8;0,1\n";
  std::string wide = "\xFF\xFE", returns = utf8;
  for (const char c : utf8) wide += std::string{c, '\0'};
  std::ranges::replace(returns, '\n', '\r');
  for (const std::string& text :
       {utf8, wide, returns, std::string("1|2|3.5\n-4|5e2|6\n7|8|0.1\n"),
        std::string("x | y | z\n1 | 2 | 3.5\n-4 | 5e2 | 6\n7 | 8 | 0.1\n"),
        std::string("1,0 2,0 3,5\n-4 500 6\n7 8 0,1\n"), std::string("1,0\t2\t3,5\n-4\t500\t6\n7\t8\t0,1\n"),
        std::string("x y z\n1,0 2,0 3,5\n-4 500 6\n7 8 0,1\n"), std::string("1|2|3,5\n-4|500|6\n7|8|0,1\n"),
        std::string("x,y,z\n1,2,\"3,5\"\n-4,500,6\n7,8,\"0,1\"\n"),
        std::string("sep=;\n1;2;3.5\n-4;500;6\n7;8;0.1\n"),
        std::string("  0.1D+01 0.2D1 3.5d0\n -4.0D0 5.0D+02 6.D0\n 7 8 1.0D-01\n"),
        std::string("P1 1 2 3.5\nP2 -4 500 6\nP3 7 8 0.1\n"),
        std::string("P1,1,2,3.5,oak\nP2,-4,500,6,ash\nP3,7,8,0.1,elm\n"),
        std::string("NaN NaN NaN\n1 2 3.5\n0 0 nan\nNaN NaN NaN\n-4 500 6\n1 1 NaN\n2 2 -nan\n3 3 -1.#IND\n7 "
                    "8 0.1\n"),
        std::string("1,2,3.5\n0,0,\n-4,500,6\n1,1,NA\n2,2,null\n7,8,0.1\n")}) {
    SCOPED_TRACE(text);
    expectTheThree(readOrFail(folder.write("points.txt", text)));
  }
  // Each is said, but what is no guess.
  const auto warnings = [&](const char* text) {
    return joined(readOrFail(folder.write("points.txt", text)).warnings);
  };
  EXPECT_TRUE(contains(warnings("1;2;3,5\n4;5;6\n7;9;8\n"), "decimal comma"));
  EXPECT_TRUE(contains(warnings("A 1 2 3\nB 4 5 6\nC 7 9 8\n"), "taken for a label"));
  EXPECT_TRUE(contains(warnings("1 2 3\n0 1 nan\n4 5 6\n0 2 nan\n7 9 8\n"), "2 points have no height"));
  EXPECT_TRUE(contains(warnings("1 2 3\n0 1 nan\n4 5 6\n0 2 nan\n7 9 8\n"), "line 2"));
  // Number, easting, northing, height: without names it is read as x, y, z, and said.
  EXPECT_TRUE(contains(warnings("1,400,500,9\n2,410,510,8\n3,420,500,7\n"), "counts the points"));
  EXPECT_EQ(warnings("1,400,500\n2,410,510\n3,420,500\n"), "");
  EXPECT_EQ(warnings("1,400,500,9\n2,410,510,8\n5,420,500,7\n"), "");
  EXPECT_EQ(warnings("1 2 3.5 | one\n-4 500 6 | two\n7 8 0.1 | three\n"), "");
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
  for (const Case& c :
       {Case{"1,2,3\n4,five,6\n", 2, "'five'"}, Case{"x,y,z\n1,2,3\n4,5\n", 3, "'4,5'"},
        Case{"1,2,3\n\n# no\n4,nan,5\n", 4, "has no y"}, Case{"1,2,inf\n", 1, "'inf'"},
        Case{"1,2,1e999\n", 1, "'1e999'"}, Case{"1;2;3.5\n1;2;3,5\n", 2, "'3,5'"},
        Case{"1,2,3m\n", 1, "'3m'"}, Case{"1,,2\n", 1, "has no y"},
        Case{"1;2;1.234,5\n", 1, "a point and a comma"}, Case{"1;2;1,234,567\n", 1, "several commas"},
        Case{"1;2;1'234\n", 1, "grouped"}, Case{"a,1,b\n", 1, "'a'"}, Case{"1,2,-1.#INF\n", 1, "'-1.#INF'"},
        Case{"1,2,\"1,234\"\n", 1, "grouped digits"}, Case{"1,2,3D\n", 1, "'3D'"},
        Case{"x,y,z\n1,5,2,5,3,5\n", 2, "6 numbers for 3 columns"}}) {
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

TEST(PointReader, GivesAPlaceOneHeightByTheRuleStated) {
  TemporaryFolder folder;
  // Four heights at 4, 5, one of them twice, and two at 9, 9.
  const std::string path =
      folder.write("fold.csv", "x,y,z\n1,2,3\n4,5,6\n9,9,9\n4,5,6.5\n9,9,8\n4,5,1\n4,5,6\n");
  for (const auto& [rule, at45, at99] :
       {std::tuple{SamePlace::least, 1.0, 8.0}, std::tuple{SamePlace::greatest, 6.5, 9.0},
        std::tuple{SamePlace::mean, 4.875, 8.5}, std::tuple{SamePlace::first, 6.0, 9.0}}) {
    const PointRead read = readOrFail(path, {.samePlace = rule});
    EXPECT_EQ(read.heightfield.positions, (std::vector<Vec2>{{1, 2}, {4, 5}, {9, 9}}));
    EXPECT_EQ(read.heightfield.heights, (std::vector<double>{3, at45, at99}));
    EXPECT_TRUE(contains(joined(read.warnings), "2 places have several heights, up to 5 from the first"))
        << joined(read.warnings);
    EXPECT_TRUE(contains(joined(read.warnings), "3 points are left out")) << joined(read.warnings);
    EXPECT_TRUE(contains(joined(read.warnings), "1 point repeats")) << joined(read.warnings);
  }
  EXPECT_EQ(errorOf(path).code, ErrorCode::degenerate);
  const PointRead huge = readOrFail(folder.write("huge.csv", "0,0,1.5e308\n0,0,1.7e308\n1,0,2\n0,1,3\n"),
                                    {.samePlace = SamePlace::mean});
  EXPECT_TRUE(std::isfinite(huge.heightfield.heights[0]));
  for (const char* name : {"error", "min", "max", "mean", "first"}) EXPECT_TRUE(samePlaceNamed(name)) << name;
  EXPECT_FALSE(samePlaceNamed("median"));
}

TEST(PointReader, LeavesNodataPointsOut) {
  TemporaryFolder folder;
  PointReadOptions options;
  options.nodata = -9999;
  const PointRead read =
      readOrFail(folder.write("voids.csv", "1,2,3.5\n0,0,-9999\n-4,500,6\n7,8,0.1\n"), options);
  expectTheThree(read);
  EXPECT_TRUE(contains(joined(read.warnings), "1 point of the height -9999 is left out"))
      << joined(read.warnings);
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
  EXPECT_TRUE(contains(flat.message, "`zField`") && contains(flat.message, "h, label")) << flat.describe();
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

}  // namespace
}  // namespace arete
