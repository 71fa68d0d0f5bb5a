// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle of a transformed place is GDAL's own transformation, called place by place.
#include "io/geo/features/feature_layer.h"

#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "io/geo/crs/reader.h"
#include "io/io_fixture.h"
#include "io/vector_fixture.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

using test::TemporaryFolder;
using test::writeVector;

/// 4 by 3 samples, 1000 units (or 1/8 degree) apart.
TerrainModel demIn(const std::string& crs) {
  RasterHeightfield field;
  field.columns = 4;
  field.rows = 3;
  field.heights.assign(12, 100);
  OGRSpatialReference parsed;
  if (!crs.empty()) {
    EXPECT_EQ(parsed.SetFromUserInput(crs.c_str()), OGRERR_NONE);
    EXPECT_TRUE(describeCrs(parsed, field.georeference));
  }
  field.georeference.geoTransform = field.georeference.isGeographic
                                        ? std::array<double, 6>{-117.25, 0.125, 0, 34.25, 0, -0.125}
                                        : std::array<double, 6>{498000, 1000, 0, 3764000, 0, -1000};
  field.georeference.hasGeoTransform = true;
  Result<TerrainModel> model = build(field);
  EXPECT_TRUE(model);
  return std::move(*model);
}

FeatureLayer read(const std::string& path, const std::string& crs = "EPSG:32611",
                  const FeatureReadOptions& options = {}) {
  auto layer = readFeatures(path, demIn(crs), options);
  EXPECT_TRUE(layer) << layer.error().describe();
  return layer ? std::move(*layer) : FeatureLayer{};
}

Error errorOf(const std::string& path, const std::string& crs = "EPSG:32611",
              const FeatureReadOptions& options = {}) {
  auto layer = readFeatures(path, demIn(crs), options);
  EXPECT_FALSE(layer) << path;
  return layer ? Error{} : layer.error();
}

Vec2 oracle(double lon, double lat) {
  static const std::unique_ptr<OGRCoordinateTransformation> there = [] {
    OGRSpatialReference a, b;
    a.SetFromUserInput("OGC:CRS84");
    b.SetFromUserInput("EPSG:32611");
    b.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return std::unique_ptr<OGRCoordinateTransformation>(OGRCreateCoordinateTransformation(&a, &b));
  }();
  EXPECT_TRUE(there->Transform(1, &lon, &lat));
  return {lon, lat};
}

bool says(const Warnings& warnings, const std::string& part) {
  return std::ranges::any_of(warnings,
                             [&](const Warning& w) { return w.sentence.find(part) != std::string::npos; });
}

constexpr const char* kCollection = R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"name":"Peak \u00e9"},"geometry":{"type":"Point","coordinates":[-117,34,1234.5]}},
{"type":"Feature","properties":{"name":"Way"},"geometry":{"type":"LineString","coordinates":[[-117,34],[-116.99,34.01]]}},
{"type":"Feature","properties":{"name":"Lot"},"geometry":{"type":"Polygon","coordinates":[[[-117,34],[-116.99,34],[-116.99,34.01],[-117,34]]]}},
{"type":"Feature","properties":{"name":null},"geometry":{"type":"MultiPoint","coordinates":[[-117,34],[-116.98,34]]}},
{"type":"Feature","properties":{"name":"nowhere"},"geometry":null}]})";

TEST(FeatureLayer, HoldsPointsLinesOutlinesAndLabels) {
  const TemporaryFolder folder;
  const FeatureLayer layer = read(folder.write("a.geojson", kCollection), "EPSG:32611", {.label = "name"});
  ASSERT_EQ(layer.points.size(), 3u);
  ASSERT_EQ(layer.lines.size(), 2u);
  EXPECT_EQ(layer.polygons, 1u);
  EXPECT_EQ(layer.features, 5u);
  const Vec2 peak = oracle(-117, 34);
  EXPECT_NEAR(layer.points[0].xy.x, peak.x, 1e-6);
  EXPECT_NEAR(layer.points[0].xy.y, peak.y, 1e-6);
  EXPECT_EQ(layer.points[0].z, 1234.5);
  EXPECT_TRUE(std::isnan(layer.points[1].z));
  ASSERT_EQ(layer.labels.size(), 3u);
  EXPECT_EQ(layer.labels[0].text, "Peak \xC3\xA9");
  EXPECT_EQ(layer.labels[1].text, "Way");
  EXPECT_EQ(layer.labels[1].line, 0u);
  EXPECT_EQ(layer.labels[2].line, FeatureLayer::kNoLine) << "the label of a polygon is inside of it";
  EXPECT_EQ(layer.labels[2].polygon, 0u);
  EXPECT_EQ(layer.labels[2].endPolygon, 1u);
  const FeatureLayer::Line& ring = layer.lines[1];
  EXPECT_EQ(layer.vertices[ring.first], layer.vertices[ring.first + ring.count - 1]);
  EXPECT_TRUE(says(layer.warnings, "1 feature without a geometry"));
}

TEST(FeatureLayer, ReadsTheSameLineFromEveryFormat) {
  const TemporaryFolder folder;
  const Vec2 from = oracle(-117, 34), to = oracle(-116.99, 34.01);
  for (const auto& [driver, name] :
       std::vector<std::pair<const char*, const char*>>{{"GPKG", "a.gpkg"},
                                                        {"ESRI Shapefile", "a.shp"},
                                                        {"GeoJSON", "a.geojson"},
                                                        {"FlatGeobuf", "a.fgb"},
                                                        {"KML", "a.kml"},

                                                        {"SQLite", "a.sqlite"}}) {
    const std::string path =
        writeVector(folder.file(name), driver,
                    {{"a", wkbLineString, {{"LINESTRING (-117 34, -116.99 34.01)", 0}}}}, "OGC:CRS84");
    const FeatureLayer layer = read(path);
    ASSERT_EQ(layer.lines.size(), 1u) << driver;
    EXPECT_NEAR(layer.vertices.front().x, from.x, 1e-3) << driver;
    EXPECT_NEAR(layer.vertices.front().y, from.y, 1e-3) << driver;
    EXPECT_NEAR(layer.vertices.back().x, to.x, 1e-3) << driver;
    EXPECT_NEAR(layer.vertices.back().y, to.y, 1e-3) << driver;
  }
}

TEST(FeatureLayer, TakesLatitudeBeforeLongitudeWhereAFormatSaysSo) {
  const TemporaryFolder folder;
  const FeatureLayer layer = read(folder.write(
      "a.gml",
      R"(<?xml version="1.0"?><gml:FeatureCollection xmlns:w="urn:w" xmlns:gml="http://www.opengis.net/gml/3.2">)"
      R"(<gml:featureMember><w:P gml:id="p"><w:g><gml:Point gml:id="q" srsName="urn:ogc:def:crs:EPSG::4326">)"
      R"(<gml:pos>34 -117</gml:pos></gml:Point></w:g></w:P></gml:featureMember></gml:FeatureCollection>)"));
  ASSERT_EQ(layer.points.size(), 1u);
  EXPECT_NEAR(layer.points[0].xy.x, oracle(-117, 34).x, 1e-6);
}

TEST(FeatureLayer, ReadsGpxTracksWithoutTheirPoints) {
  const TemporaryFolder folder;
  const std::string track =
      "<trk><name>up</name><trkseg><trkpt lat=\"34\" lon=\"-117\"><ele>7</ele></trkpt>"
      "<trkpt lat=\"34.01\" lon=\"-116.99\"><ele>8</ele></trkpt></trkseg></trk>";
  const auto gpx = [](const std::string& body) {
    return "<?xml version=\"1.0\"?><gpx version=\"1.1\" xmlns=\"http://www.topografix.com/GPX/1/1\">" + body +
           "</gpx>";
  };
  const FeatureLayer layer = read(folder.write("a.gpx", gpx(track)), "EPSG:32611", {.label = "name"});
  EXPECT_EQ(layer.name, "tracks");
  ASSERT_EQ(layer.lines.size(), 1u);
  ASSERT_EQ(layer.z.size(), layer.vertices.size());
  EXPECT_EQ(layer.z.front(), 7);
  EXPECT_EQ(layer.z.back(), 8);
  const std::string two =
      folder.write("b.gpx", gpx("<wpt lat=\"34\" lon=\"-117\"><name>hut</name></wpt>" + track));
  const Error error = errorOf(two);
  EXPECT_EQ(error.code, ErrorCode::unsupported);
  EXPECT_NE(error.message.find("waypoints"), std::string::npos) << error.message;
  EXPECT_EQ(read(two, "EPSG:32611", {.layer = "waypoints"}).points.size(), 1u);
}

TEST(FeatureLayer, TakesColumnsNamedLongitudeAndLatitudeAsSuch) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("a.csv", "\xEF\xBB\xBFname,lat,lon\n\"Hut, old\",34,-117\nTop,34.01,-116.99\n");
  const FeatureLayer layer = read(path, "EPSG:32611", {.label = "NAME"});
  ASSERT_EQ(layer.points.size(), 2u);
  EXPECT_NEAR(layer.points[0].xy.x, oracle(-117, 34).x, 1e-6);
  EXPECT_NEAR(layer.points[1].xy.y, oracle(-116.99, 34.01).y, 1e-6);
  ASSERT_EQ(layer.labels.size(), 2u);
  EXPECT_EQ(layer.labels[0].text, "Hut, old");
  EXPECT_TRUE(says(layer.warnings, "WGS 84"));
  // On a map of longitudes they are the DEM's, as x and y are everywhere.
  EXPECT_EQ(read(path, "OGC:CRS84").points[0].xy, (Vec2{-117, 34}));
  const std::string plain = folder.write("b.csv", "x,y\n500000,3762000\n");
  const FeatureLayer same = read(plain);
  ASSERT_EQ(same.points.size(), 1u);
  EXPECT_EQ(same.points[0].xy, (Vec2{500000, 3762000}));
  EXPECT_TRUE(same.warnings.empty());
  EXPECT_NEAR(
      read(folder.write("c.csv", "x,y\n-117,34\n"), "EPSG:32611", {.crs = "OGC:CRS84"}).points[0].xy.x,
      oracle(-117, 34).x, 1e-6);
}

TEST(FeatureLayer, TakesTheHeightsOfATableFromTheirColumn) {
  const TemporaryFolder folder;
  for (const char* name : {"z", "Height", "elevation"}) {
    const FeatureLayer layer = read(folder.write(
        "a.csv", std::string("x,y,what,") + name + "\n500000,3762000,hut,200\n500100,3762000,top,\n"));
    ASSERT_EQ(layer.points.size(), 2u) << name;
    EXPECT_EQ(layer.points[0].z, 200) << name;
    EXPECT_TRUE(std::isnan(layer.points[1].z)) << name;
  }
}

TEST(FeatureLayer, ReadsLinesInWktFromText) {
  const TemporaryFolder folder;
  for (const char* name : {"WKT", "the_geom", "geometry"}) {
    const FeatureLayer layer = read(folder.write(
        "a.csv", std::string("id,") + name + "\n1,\"LINESTRING (500000 3762000, 501000 3762500)\"\n"));
    ASSERT_EQ(layer.lines.size(), 1u) << name;
    EXPECT_EQ(layer.vertices[1], (Vec2{501000, 3762500})) << name;
  }
}

TEST(FeatureLayer, SaysWhereACrsIsAssumed) {
  const TemporaryFolder folder;
  const std::string path = writeVector(folder.file("a.shp"), "ESRI Shapefile",
                                       {{"a", wkbPoint, {{"POINT (500000 3762000)", 0}}}}, nullptr);
  const FeatureLayer layer = read(path);
  EXPECT_EQ(layer.points[0].xy, (Vec2{500000, 3762000}));
  EXPECT_TRUE(says(layer.warnings, "has no CRS"));
  EXPECT_EQ(errorOf(folder.write("a.geojson", kCollection), "").code, ErrorCode::invalidData)
      << "a file with a CRS on a DEM without";
}

TEST(FeatureLayer, FollowsAnEdgeWhereItsOwnCrsLeadsItStraight) {
  // A degree of a parallel bends by hundreds of metres in UTM.
  const TemporaryFolder folder;
  const FeatureLayer layer =
      read(folder.write("a.geojson", R"({"type":"LineString","coordinates":[[-118,34,10],[-116,34,30]]})"));
  ASSERT_EQ(layer.lines.size(), 1u);
  ASSERT_GT(layer.vertices.size(), 8u);
  double worst = 0;
  for (int i = 0; i <= 1000; ++i) {
    const Vec2 p = oracle(-118 + 2 * i / 1000.0, 34);
    double nearest = 1e300;
    for (std::size_t k = 1; k < layer.vertices.size(); ++k) {
      const Vec2 a = layer.vertices[k - 1], b = layer.vertices[k];
      const double dx = b.x - a.x, dy = b.y - a.y;
      const double t = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
      nearest = std::min(nearest, std::hypot(a.x + t * dx - p.x, a.y + t * dy - p.y));
    }
    worst = std::max(worst, nearest);
  }
  EXPECT_LT(worst, 0.1 * 1000) << "a tenth of the spacing";
  for (std::size_t k = 1; k < layer.z.size(); ++k) EXPECT_GT(layer.z[k], layer.z[k - 1]);
  EXPECT_NEAR(layer.z[layer.z.size() / 2], 20, 3);
}

TEST(FeatureLayer, LeadsALineAcrossTheAntimeridianTheShortWay) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("a.geojson", R"({"type":"LineString","coordinates":[[179.5,0],[-179.5,1]]})");
  for (const char* crs : {"OGC:CRS84", "EPSG:3857", "EPSG:3832"}) {
    const FeatureLayer layer = read(path, crs);
    ASSERT_EQ(layer.lines.size(), 1u) << crs;
    double length = 0;
    for (std::size_t k = 1; k < layer.vertices.size(); ++k)
      length += std::abs(layer.vertices[k].x - layer.vertices[k - 1].x);
    EXPECT_NEAR(length, std::string(crs) == "OGC:CRS84" ? 1 : 111319.5, 200) << crs;
  }
}

TEST(FeatureLayer, CutsALineWhereTheCrsDoesNotReachAndCountsIt) {
  const TemporaryFolder folder;
  const FeatureLayer layer = read(folder.write(
      "a.geojson",
      R"({"type":"LineString","coordinates":[[-117,34],[-116.9,34],[-117,95],[-117,34.1],[-116.9,34.1]]})"));
  EXPECT_EQ(layer.lines.size(), 2u);
  EXPECT_TRUE(says(layer.warnings, "outside the domain"));
}

TEST(FeatureLayer, NamesFileLayerAndFieldInErrors) {
  const TemporaryFolder folder;
  const std::string json = folder.write("a.geojson", kCollection);
  Error error = errorOf(json, "EPSG:32611", {.label = "nom"});
  EXPECT_EQ(error.code, ErrorCode::notFound);
  EXPECT_NE(error.message.find("its fields: name"), std::string::npos) << error.message;
  EXPECT_EQ(error.culprit, json);
  EXPECT_EQ(errorOf(json, "EPSG:32611", {.layer = "b"}).code, ErrorCode::notFound);
  EXPECT_EQ(errorOf(folder.file("none.gpkg")).code, ErrorCode::notFound);
  EXPECT_EQ(errorOf(folder.write("b.geojson", "{\"type\":\"FeatureCollection\",\"features\":[]}")).code,
            ErrorCode::invalidData);
  const std::string two = writeVector(
      folder.file("two.gpkg"), "GPKG",
      {{"roads", wkbLineString, {{"LINESTRING (0 0, 1 1)", 0}}}, {"peaks", wkbPoint, {{"POINT (0 0)", 0}}}});
  error = errorOf(two);
  EXPECT_NE(error.message.find("roads, peaks"), std::string::npos) << error.message;
  EXPECT_EQ(read(two, "EPSG:32611", {.layer = "peaks"}).points.size(), 1u);
  error = errorOf(json, "EPSG:32611", {.mostVertices = 3});
  EXPECT_EQ(error.code, ErrorCode::unsupported);
  EXPECT_NE(error.message.find("more than 3 vertices"), std::string::npos) << error.message;
  EXPECT_EQ(errorOf(json, "EPSG:32611", {.crs = "nonsense"}).code, ErrorCode::usage);
}

TEST(FeatureLayer, TakesCurvesAndCollections) {
  const TemporaryFolder folder;
  const std::string path = writeVector(
      folder.file("a.gpkg"), "GPKG",
      {{"a",
        wkbUnknown,
        {{"CIRCULARSTRING (499000 3762000, 500000 3763000, 501000 3762000)", 0},
         {"GEOMETRYCOLLECTION (POINT (500000 3762000), LINESTRING (499000 3762000, 500000 3762500))", 0}}}});
  const FeatureLayer layer = read(path);
  EXPECT_EQ(layer.points.size(), 1u);
  ASSERT_EQ(layer.lines.size(), 2u);
  for (std::uint64_t i = 0; i < layer.lines[0].count; ++i)
    EXPECT_NEAR(std::hypot(layer.vertices[i].x - 500000, layer.vertices[i].y - 3762000), 1000, 1e-6);
}

TEST(FeatureLayer, TakesFeaturesThatMeetACondition) {
  const TemporaryFolder folder;
  for (const auto& [driver, name] : std::vector<std::pair<const char*, const char*>>{
           {"GPKG", "a.gpkg"}, {"FlatGeobuf", "a.fgb"}, {"ESRI Shapefile", "a.shp"}}) {
    const std::string path = writeVector(
        folder.file(name), driver,
        {{"a",
          wkbPoint,
          {{"POINT (500000 3762000)", 1}, {"POINT (500100 3762000)", 2}, {"POINT (500200 3762000)", 3}}}});
    EXPECT_EQ(read(path, "EPSG:32611", {.where = "h >= 2"}).points.size(), 2u) << driver;
    // SQLite finds out while it reads.
    const ErrorCode wrong = errorOf(path, "EPSG:32611", {.where = "no such"}).code;
    EXPECT_EQ(wrong, driver == std::string("GPKG") ? ErrorCode::unreadable : ErrorCode::usage) << driver;
    const Error none = errorOf(path, "EPSG:32611", {.where = "h > 9"});
    EXPECT_EQ(none.code, ErrorCode::invalidData) << driver;
    EXPECT_NE(none.message.find("meets the condition h > 9"), std::string::npos) << none.message;
  }
  EXPECT_EQ(errorOf(folder.write("a.csv", "x,y\n500000,3762000\n"), "EPSG:32611", {.where = "x > 1"}).code,
            ErrorCode::usage);
}

TEST(FeatureLayer, LeadsHeightsIntoTheUnitOfTheDem) {
  const TemporaryFolder folder;
  TerrainModel inFeet = demIn("EPSG:32611");
  inFeet.georeference.verticalUnit = std::string("ft");
  inFeet.georeference.verticalUnitMetres = 0.3048;
  // GeoJSON states metres; a projected CRS without a vertical part states nothing, and its heights are the
  // DEM's.
  const auto json = readFeatures(folder.write("a.geojson", kCollection), inFeet);
  ASSERT_TRUE(json);
  EXPECT_NEAR(json->points[0].z, 1234.5 / 0.3048, 1e-9);
  const std::string path =
      writeVector(folder.file("a.gpkg"), "GPKG", {{"a", wkbPoint25D, {{"POINT Z (500000 3762000 70)", 1}}}});
  const auto same = readFeatures(path, inFeet);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->points[0].z, 70);
}

TEST(FeatureLayer, KeepsLabelsOfOtherEncodings) {
  const TemporaryFolder folder;
  // A shapefile says in a .cpg how its texts are encoded.
  const std::string path =
      writeVector(folder.file("a.shp"), "ESRI Shapefile", {{"a", wkbPoint, {{"POINT (500000 3762000)", 0}}}});
  for (const auto& [encoding, bytes] :
       std::vector<std::pair<const char*, std::string>>{{"CP1252", "\xE9"}, {"UTF-8", "\xC3\xA9"}}) {
    folder.write("a.cpg", encoding);
    std::string dbf(folder.file("a.dbf"));
    std::ifstream in(dbf, std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    in.close();
    const std::size_t header = std::size_t(static_cast<unsigned char>(text[8])) +
                               256 * std::size_t(static_cast<unsigned char>(text[9]));
    std::fill(text.begin() + std::ptrdiff_t(header) + 1, text.end() - 1, ' ');
    text.replace(header + 1 + 24, bytes.size(), bytes);
    folder.write("a.dbf", text);
    const FeatureLayer layer = read(path, "EPSG:32611", {.label = "label"});
    ASSERT_EQ(layer.labels.size(), 1u) << encoding;
    EXPECT_EQ(layer.labels[0].text, "\xC3\xA9") << encoding;
  }
}

}  // namespace
}  // namespace arete
