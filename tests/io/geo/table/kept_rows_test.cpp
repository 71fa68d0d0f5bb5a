// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tables with gaps, points as text, and typed layers: each row and each value comes back as it was.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <cmath>

#include "io/geo/gdal/support.h"
#include "io/geo/table/height_table.h"
#include "io/geo/table/plan_point_reader.h"
#include "io/geo/table/point_table.h"
#include "io/io_fixture.h"
#include "io/table_fixture.h"

namespace arete {
namespace {

using test::contains;
using test::csvOf;
using test::joined;
using test::TemporaryFolder;
using test::utm;

TEST(KeptRows, OfATextWithoutACoordinateStayEmptyAndAreCounted) {
  struct Case {
    const char* text;
    std::vector<bool> hasPlace;
  };
  const TemporaryFolder folder;
  for (const Case& c : {
           Case{"x,y\n500105,\n500105,5199905\n", {false, true}},
           Case{"x,y\n,5199905\n500105,5199905\n", {false, true}},
           Case{"x,y,name\n1,2,a\n,,b\n3,4,c\n", {true, false, true}},
           Case{"name,x,y\na,1,2\nb,,\nc,nan,4\nd,5,NA\n", {true, false, false, false}},
           Case{"x;y;z\n1;2;3\n;;4\n", {true, false}},
           Case{"x\ty\n1\t2\n\t\n3\t4\n", {true, true}},  // a line of blanks is none
           Case{"x|y|n\n1|2|a\n||b\n", {true, false}},
           Case{"lon,lat\nnull,null\n1,2\n", {false, true}},
           Case{"x,y\n-,-\n1,2\n", {false, true}},
           Case{"x,y\n1,2\n\"\",\"\"\n", {true, false}},
           Case{"WKT,name\nPOINT(1 2),a\n,b\nPOINT EMPTY,c\n", {true, false, false}},
           Case{"1,2\n3,\n", {true, false}},
       }) {
    const auto table = readPointTable(folder.write("a.csv", c.text), utm());
    ASSERT_TRUE(table) << c.text << table.error().describe();
    std::vector<bool> hasPlace;
    std::uint64_t without = 0;
    for (std::size_t i = 0; i < table->stated.size(); ++i) {
      hasPlace.push_back(std::isfinite(table->stated[i].x) && std::isfinite(table->stated[i].y));
      EXPECT_EQ(std::isfinite(table->positions[i].x), hasPlace.back()) << c.text;
      without += hasPlace.back() ? 0 : 1;
    }
    EXPECT_EQ(hasPlace, c.hasPlace) << c.text;
    EXPECT_EQ(table->withoutPlace, without) << c.text;
    if (!table->attributes.columns.empty()) {
      EXPECT_EQ(table->attributes.rows(), hasPlace.size()) << c.text;
    }
    const std::string csv = csvOf(*table, std::vector<std::optional<GroundHeight>>(hasPlace.size()));
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), std::ptrdiff_t(hasPlace.size()) + 1) << csv;
  }
}

TEST(KeptRows, WithOneCoordinateKeepIt) {
  struct Case {
    const char* text;
    const char* csv;
  };
  const TemporaryFolder folder;
  for (const Case& c : {
           Case{"x,y\n500105,\n500105,5199905\n", "500105,,,,\n500105,5199905,,,\n"},
           Case{"x,y\n,5199905.25\n500105,5199905\n", ",5199905.25,,,\n500105,5199905,,,\n"},
           Case{"x,y\n,\n500105,5199905\n", ",,,,\n500105,5199905,,,\n"},
           Case{"x;y\n1,5;NA\n1;2\n", "1.5,,,,\n1,2,,,\n"},
           Case{"1,2\n3,\n", "1,2,,,\n3,,,,\n"},
           Case{"name,lon,lat,z\na,-117,,9\nb,-117,34,8\n", "a,9,-117,,,,\nb,8,-117,34,,,\n"},
           Case{"y,x\n5,\n6,7\n", ",5,,,\n7,6,,,\n"},
       }) {
    for (const bool isLonLat : {false, true}) {
      const auto table = readPointTable(folder.write("a.csv", c.text), utm(), {.lonLat = isLonLat});
      ASSERT_TRUE(table) << c.text << table.error().describe();
      const std::vector<std::optional<GroundHeight>> none(table->stated.size());
      const std::string csv = csvOf(*table, none);
      EXPECT_EQ(csv.substr(csv.find('\n') + 1), c.csv) << c.text;
      EXPECT_EQ(table->withoutPlace, 1u) << c.text;
      // The same from a GeoPackage, which has no geometry for such a row.
      ASSERT_TRUE(writeHeightTable(folder.file("a.gpkg"), *table, none)) << c.text;
      const auto back = readPointTable(folder.file("a.gpkg"), utm());
      ASSERT_TRUE(back) << c.text << back.error().describe();
      EXPECT_EQ(back->withoutPlace, 1u) << c.text;
      for (std::size_t i = 0; i < table->stated.size(); ++i) {
        EXPECT_EQ(std::isfinite(table->positions[i].x), std::isfinite(table->positions[i].y)) << c.text;
        const std::size_t x = back->attributes.columns.size() - 5;  // x, y, height, below, above
        const auto textOf = [](double v) { return std::isfinite(v) ? fmt::format("{}", v) : std::string(); };
        EXPECT_EQ(back->attributes.at(i, x), textOf(table->stated[i].x)) << c.text;
        EXPECT_EQ(back->attributes.at(i, x + 1), textOf(table->stated[i].y)) << c.text;
      }
    }
  }
}

TEST(KeptRows, AreNoneWhereTheTextIsDamaged) {
  const TemporaryFolder folder;
  for (const char* text : {"x,y\n1,2\n3\n", "x,y\n1,2\n3,abc\n", "x,y\n1,2\n3,inf\n", "WKT,n\nPOINT(1 2,a\n",
                           "WKT\n\"POINT (1 2)\"\n\"POINT (3", "WKT,n\n\"LINESTRING (0 0,1 1)\",a\n",
                           "the_geom,n\nSRID=4326;POINT(1 2),a\nSRID=32611;POINT(1 2),b\n"}) {
    const auto table = readPointTable(folder.write("a.csv", text), utm());
    ASSERT_FALSE(table) << text;
    EXPECT_EQ(table.error().code, ErrorCode::invalidData) << table.error().describe();
    EXPECT_TRUE(contains(table.error().culprit, "a.csv:")) << table.error().describe();
  }
  EXPECT_FALSE(readPlanPoints(folder.write("a.csv", "x,y\n1,\n"), "")) << "places must be there";
}

TEST(KeptRows, OfPointsAsTextAreReadByAnyNameOfTheColumn) {
  struct Case {
    const char* text;
    std::optional<double> z = {};
  };
  const TemporaryFolder folder;
  for (const Case& c : {
           Case{"WKT,name\nPOINT(500105 5199905),a\n"},
           Case{"wkt,name\n\"POINT (500105 5199905)\",a\n"},
           Case{"name,geometry\na,POINT (500105 5199905)\n"},
           Case{"name,the_geom\na,\"POINT (500105 5199905)\"\n"},
           Case{"geom;name\nPOINT (500105 5199905);a\n"},
           Case{"wkt_geom\tname\nPOINT (500105 5199905)\ta\n"},
           Case{"WKT\n\"POINT (500105 5199905)\"\n"},
           Case{"WKT\nPOINT (500105 5199905)\n"},
           Case{"WKT,\n\"POINT (500105 5199905)\",\n"},
           Case{"POINT (500105 5199905)\n"},
           Case{"a,POINT (500105 5199905)\n"},
           Case{"WKT,n\nPOINT Z (500105 5199905 12.5),a\n", 12.5},
           Case{"WKT,n\n\"POINTZ(500105 5199905 12.5)\",a\n", 12.5},
           Case{"WKT,n\n\"MULTIPOINT ((500105 5199905))\",a\n"},
           Case{"the_geom,n\nSRID=32611;POINT(500105 5199905),a\n"},
           Case{"the_geom,n\n\"SRID=32611;POINT Z (500105 5199905 12.5)\",a\n", 12.5},
           Case{"the_geom;n\n\"SRID=32611;POINT(500105 5199905)\";a\n"},
           Case{"GEOMETRY,n\npoint(500105 5199905),\"a, b\"\n"},
       }) {
    const auto table = readPointTable(folder.write("a.csv", c.text), utm());
    ASSERT_TRUE(table) << c.text << table.error().describe();
    ASSERT_EQ(table->positions.size(), 1u) << c.text;
    EXPECT_EQ(table->positions[0], (Vec2{500105, 5199905})) << c.text;
    EXPECT_EQ(table->z.empty(), !c.z) << c.text;
    if (c.z) {
      EXPECT_EQ(table->z[0], *c.z) << c.text;
    }
    const auto plan = readPlanPoints(folder.file("a.csv"), "EPSG:32611");
    ASSERT_TRUE(plan) << c.text << plan.error().describe();
    EXPECT_EQ(plan->positions, table->positions) << c.text;
  }
}

TEST(KeptRows, AreInTheCrsThatTheirTextStates) {
  const TemporaryFolder folder;
  const auto table = readPointTable(folder.write("a.csv", "geom\nSRID=4326;POINT(-117 34)\n"), utm());
  ASSERT_TRUE(table) << table.error().describe();
  EXPECT_EQ(table->stated[0], (Vec2{-117, 34}));
  EXPECT_NEAR(table->positions[0].x, 500000, 1) << "the middle meridian of the zone";
  EXPECT_TRUE(contains(table->crsWkt, "4326"));
  EXPECT_EQ(readPointTable(folder.file("a.csv"), {}).error().code, ErrorCode::invalidData)
      << "a DEM without a CRS";
}

TEST(KeptRows, KeepIntegersOfMoreDigitsThanANumberHasAsText) {
  PointAttributes attributes;
  attributes.columns = {{"id"}, {"number"}, {"code"}};
  for (const char* value : {"12345678901234567890", "1234567890123456789", "007"}) attributes.add(value);
  attributes.findKinds();
  EXPECT_EQ(attributes.columns[0].kind, PointAttributes::Kind::text);
  EXPECT_EQ(attributes.columns[1].kind, PointAttributes::Kind::integer);
  EXPECT_EQ(attributes.columns[2].kind, PointAttributes::Kind::text);
}

struct Field {
  const char* name;
  OGRFieldType type;
  OGRFieldSubType subtype;
  const char* value;  ///< as GDAL takes it
  const char* csv;    ///< as it is written
};

const std::vector<Field> kFields = {
    {"i", OFTInteger, OFSTNone, "42", "42"},
    {"small", OFTInteger, OFSTInt16, "-7", "-7"},
    {"yes", OFTInteger, OFSTBoolean, "1", "1"},
    {"no", OFTInteger, OFSTBoolean, "0", "0"},
    {"big", OFTInteger64, OFSTNone, "9007199254740993", "9007199254740993"},
    {"real", OFTReal, OFSTNone, "0.1", "0.1"},
    {"single", OFTReal, OFSTFloat32, "0.25", "0.25"},
    {"day", OFTDate, OFSTNone, "2020-02-29", "2020-02-29"},
    {"old", OFTDate, OFSTNone, "0987-01-02", "0987-01-02"},
    {"moment", OFTDateTime, OFSTNone, "2020-02-29T12:34:56Z", "2020-02-29T12:34:56Z"},
    {"exact", OFTDateTime, OFSTNone, "2020-02-29T12:34:56.789Z", "2020-02-29T12:34:56.789Z"},
    {"text", OFTString, OFSTNone, "a, \"b\"", "\"a, \"\"b\"\"\""},
    {"code", OFTString, OFSTNone, "007", "007"},
    {"json", OFTString, OFSTJSON, "{}", "{}"},
};

std::string typedLayer(const TemporaryFolder& folder) {
  registerGdal();
  const std::string path = folder.file("typed.gpkg");
  GDALDataset* dataset =
      GetGDALDriverManager()->GetDriverByName("GPKG")->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr);
  OGRSpatialReference crs;
  crs.SetFromUserInput("EPSG:32611");
  OGRLayer* layer = dataset->CreateLayer("typed", &crs, wkbPoint25D, nullptr);
  for (const Field& field : kFields) {
    OGRFieldDefn definition(field.name, field.type);
    definition.SetSubType(field.subtype);
    EXPECT_EQ(layer->CreateField(&definition), OGRERR_NONE);
  }
  for (int row = 0; row < 3; ++row) {
    OGRFeature feature(layer->GetLayerDefn());
    const OGRPoint point(500000 + row, 4000000, 77.5);
    if (row < 2) feature.SetGeometry(&point);
    if (row != 1)
      for (std::size_t i = 0; i < kFields.size(); ++i) feature.SetField(int(i), kFields[i].value);
    EXPECT_EQ(layer->CreateFeature(&feature), OGRERR_NONE);
  }
  GDALClose(GDALDataset::ToHandle(dataset));
  return path;
}

TEST(KeptRows, OfALayerKeepTheirTypesAndZ) {
  const TemporaryFolder folder;
  const auto table = readPointTable(typedLayer(folder), utm());
  ASSERT_TRUE(table) << table.error().describe();
  EXPECT_EQ(table->withoutPlace, 1u);
  const std::vector<std::optional<GroundHeight>> heights = {GroundHeight{.height = 1}, std::nullopt,
                                                            std::nullopt};
  const std::string csv = csvOf(*table, heights), own = csv.substr(csv.find('\n') + 1);
  std::string first = "1,";
  for (const Field& field : kFields) first += std::string(field.csv) + ',';
  EXPECT_EQ(own.substr(0, own.find('\n')), first + "500000,4000000,77.5,1,0,0") << csv;

  const std::string out = folder.file("out.gpkg");
  ASSERT_TRUE(writeHeightTable(out, *table, heights));
  const GdalErrors quiet;
  const GdalDatasetPtr dataset = openGdal(out, GDAL_OF_VECTOR);
  ASSERT_TRUE(dataset);
  OGRLayer& layer = *dataset->GetLayer(0);
  EXPECT_EQ(layer.GetGeomType(), wkbPoint25D);
  const OGRFeatureDefn& definition = *layer.GetLayerDefn();
  for (const Field& field : kFields) {
    const int at = definition.GetFieldIndex(field.name);
    ASSERT_GE(at, 0) << field.name;
    EXPECT_EQ(definition.GetFieldDefn(at)->GetType(), field.type) << field.name;
    EXPECT_EQ(definition.GetFieldDefn(at)->GetSubType(), field.subtype) << field.name;
  }
  int row = 0;
  for (const auto& feature : layer) {
    OGRFeature expected(layer.GetLayerDefn());
    for (const Field& field : kFields) {
      const int at = definition.GetFieldIndex(field.name);
      EXPECT_EQ(feature->IsFieldSetAndNotNull(at) != 0, row != 1) << field.name;
      if (row == 1) continue;
      expected.SetField(at, field.value);
      EXPECT_STREQ(feature->GetFieldAsString(at), std::string(expected.GetFieldAsString(at)).c_str())
          << field.name;
    }
    const OGRGeometry* geometry = feature->GetGeometryRef();
    EXPECT_EQ(geometry != nullptr, row < 2);
    if (geometry) {
      EXPECT_EQ(geometry->toPoint()->getZ(), 77.5);
    }
    ++row;
  }
  EXPECT_EQ(row, 3);
}

TEST(KeptRows, WriteMomentsInTheirZone) {
  const TemporaryFolder folder;
  struct Case {
    const char* stated;
    const char* written;
  };
  for (const Case& c : {Case{"2020-01-02T03:04:05+01:00", "2020-01-02T03:04:05+01:00"},
                        Case{"2020-01-02T03:04:05-09:30", "2020-01-02T03:04:05-09:30"},
                        Case{"2020-01-02T03:04:05Z", "2020-01-02T03:04:05Z"},
                        Case{"2020-01-02T03:04:05", "2020-01-02T03:04:05"}, Case{"2020-01-02", "2020-01-02"},
                        Case{"03:04:05", "03:04:05"}}) {
    const auto table = readPointTable(
        folder.write(
            "a.geojson",
            std::string(
                R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32611"}},)") +
                R"("features":[{"type":"Feature","properties":{"t":")" + c.stated +
                R"("},"geometry":{"type":"Point","coordinates":[1,2]}}]})"),
        utm());
    ASSERT_TRUE(table) << table.error().describe();
    EXPECT_EQ(table->attributes.at(0, 1), c.written);
  }
}

}  // namespace
}  // namespace arete
