// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/extract/region_reader.h"

#include <ogr_spatialref.h>

#include <atomic>
#include <cmath>

#include "io/geo/dem/raster_reader.h"
#include "io/georeference_fixture.h"
#include "io/io_fixture.h"
#include "io/query/extract/region_argument.h"

namespace arete {
namespace {

using test::contains;
using test::TemporaryFolder;
using ::testing::internal::CaptureStderr;
using ::testing::internal::GetCapturedStderr;

/// The even-odd rule over all rings.
bool isInside(const RegionRead& region, double x, double y) {
  bool inside = false;
  for (const auto& ring : region.rings)
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
      if ((ring[i].y > y) != (ring[j].y > y) &&
          x < (ring[j].x - ring[i].x) * (y - ring[i].y) / (ring[j].y - ring[i].y) + ring[i].x)
        inside = !inside;
  return inside;
}

RegionRead readOrFail(const std::string& path, const std::string& target = {},
                      const RegionReadOptions& options = {}) {
  auto read = readRegion(path, target, options);
  if (!read) {
    ADD_FAILURE() << read.error().describe();
    return {};
  }
  return std::move(*read);
}

Error errorOf(const std::string& path, const std::string& target = {},
              const RegionReadOptions& options = {}) {
  auto read = readRegion(path, target, options);
  if (read) ADD_FAILURE() << path << " was read";
  return read ? Error{} : read.error();
}

/// GeoJSON of one feature per geometry; without a "crs" member it is longitude, latitude.
std::string geoJson(const std::vector<std::string>& geometries, const std::string& epsg = {}) {
  std::string text = "{\"type\":\"FeatureCollection\",";
  if (!epsg.empty())
    text += "\"crs\":{\"type\":\"name\",\"properties\":{\"name\":\"urn:ogc:def:crs:EPSG::" + epsg + "\"}},";
  text += "\"features\":[";
  for (std::size_t i = 0; i < geometries.size(); ++i)
    text += std::string(i ? "," : "") +
            "{\"type\":\"Feature\",\"properties\":{},\"geometry\":" + geometries[i] + "}";
  return text + "]}";
}

const std::string kWithHole =
    "{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[10,0],[10,10],[0,10],[0,0]],[[4,4],[4,6],[6,6],[6,4],[4,"
    "4]]]}";

TEST(RegionReader, KeepsHolesAndDropsTheRepeatedVertex) {
  TemporaryFolder folder;
  const RegionRead region = readOrFail(folder.write("hole.geojson", geoJson({kWithHole}, "32611")));
  ASSERT_EQ(region.rings.size(), 2u);
  EXPECT_EQ(region.rings[0], (std::vector<Vec2>{{0, 0}, {10, 0}, {10, 10}, {0, 10}}));
  EXPECT_EQ(region.rings[1].size(), 4u);
  EXPECT_TRUE(isInside(region, 1, 1));
  EXPECT_FALSE(isInside(region, 5, 5));
}

TEST(RegionReader, ReadsMultipolygonsAndCollections) {
  TemporaryFolder folder;
  const std::string two =
      "{\"type\":\"MultiPolygon\",\"coordinates\":[[[[0,0],[1,0],[1,1],[0,0]]],[[[5,5],[6,5],[6,6],[5,5]]]]}";
  const std::string mixed =
      "{\"type\":\"GeometryCollection\",\"geometries\":[{\"type\":\"Point\",\"coordinates\":[1,2]},"
      "{\"type\":\"Polygon\",\"coordinates\":[[[20,20],[30,20],[30,30],[20,20]]]}]}";
  const RegionRead region = readOrFail(folder.write("multi.geojson", geoJson({two, mixed})));
  EXPECT_EQ(region.rings.size(), 3u);
  ASSERT_EQ(region.warnings.size(), 2u) << "the other: the CRS of the DEM is not known";
  EXPECT_TRUE(contains(region.warnings[0].sentence, "1 geometry that is no polygon"));
  EXPECT_TRUE(isInside(region, 0.9, 0.5));
  EXPECT_TRUE(isInside(region, 28, 22));
  EXPECT_FALSE(isInside(region, 3, 3));
}

TEST(RegionReader, UnitesPolygonsThatOverlap) {
  TemporaryFolder folder;
  const std::string a = "{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[6,0],[6,6],[0,6],[0,0]]]}";
  const std::string b = "{\"type\":\"Polygon\",\"coordinates\":[[[4,4],[9,4],[9,9],[4,9],[4,4]]]}";
  const RegionRead region = readOrFail(folder.write("overlap.geojson", geoJson({a, b})));
  EXPECT_TRUE(isInside(region, 5, 5)) << "inside both";
  EXPECT_TRUE(isInside(region, 1, 1));
  EXPECT_TRUE(isInside(region, 8, 8));
  EXPECT_FALSE(isInside(region, 8, 1));
}

TEST(RegionReader, ClosesRingsThatAFileLeavesOpen) {
  const TemporaryFolder folder;
  const std::string a =
      R"({"type":"Polygon","coordinates":[[[0,0],[6,0],[6,6],[0,6]],[[1,1],[1,2],[2,2],[2,1]]]})";
  const std::string b = R"({"type":"Polygon","coordinates":[[[4,4],[9,4],[9,9],[4,9]]]})";
  const std::string twice =
      R"({"type":"Polygon","coordinates":[[[20,0],[29,0],[29,9],[20,9],[20,0],[29,0],[29,9],[20,9]]]})";
  const RegionRead region =
      readOrFail(folder.write("open.geojson", geoJson({a, b, twice}, "32611")), "EPSG:32611");
  EXPECT_EQ(test::sentencesOf(region.warnings),
            std::vector<std::string>{"4 of its rings do not end where they begin; an edge closes each"});
  EXPECT_TRUE(isInside(region, 0.5, 3));
  EXPECT_FALSE(isInside(region, 1.5, 1.5)) << "in the hole";
  EXPECT_TRUE(isInside(region, 5, 5)) << "inside both";
  EXPECT_TRUE(isInside(region, 8, 8));
  EXPECT_TRUE(isInside(region, 24, 5)) << "gone around twice";
  const std::string dateline = R"({"type":"Polygon","coordinates":[[[-179,0],[-179,1],[179,1],[179,0]]]})";
  EXPECT_TRUE(contains(test::joined(readOrFail(folder.write("d.geojson", geoJson({dateline}))).warnings),
                       "more than half a turn"));
}

TEST(RegionReader, ReprojectsAndBendsLongEdges) {
  TemporaryFolder folder;
  const std::string degree =
      "{\"type\":\"Polygon\",\"coordinates\":[[[-120,40],[-115,40],[-115,45],[-120,45],[-120,40]]]}";
  const std::string path = folder.write("degree.geojson", geoJson({degree}));
  const RegionRead region = readOrFail(path, "EPSG:32611");
  ASSERT_EQ(region.rings.size(), 1u);
  EXPECT_GT(region.rings[0].size(), 16u);

  OGRSpatialReference geographic, utm;
  geographic.SetFromUserInput("EPSG:4326");
  geographic.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  utm.SetFromUserInput("EPSG:32611");
  utm.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  OGRCoordinateTransformation* toUtm = OGRCreateCoordinateTransformation(&geographic, &utm);
  for (const auto& [lon, lat, inside] :
       {std::tuple{-117.5, 40.002, true}, std::tuple{-117.5, 39.998, false}, std::tuple{-117.5, 44.998, true},
        std::tuple{-117.5, 45.002, false}, std::tuple{-119.998, 42.5, true},
        std::tuple{-120.002, 42.5, false}}) {
    double x = lon, y = lat;
    ASSERT_TRUE(toUtm->Transform(1, &x, &y));
    EXPECT_EQ(isInside(region, x, y), inside) << lon << ", " << lat;
  }
  OGRCoordinateTransformation::DestroyCT(toUtm);

  // The same CRS by another name moves nothing.
  EXPECT_EQ(readOrFail(path, "EPSG:4326").rings[0],
            (std::vector<Vec2>{{-120, 40}, {-115, 40}, {-115, 45}, {-120, 45}}));
}

TEST(RegionReader, WarnsWhereACrsIsMissing) {
  TemporaryFolder folder;
  const RegionRead region = readOrFail(folder.write("hole.geojson", geoJson({kWithHole})));
  ASSERT_EQ(region.warnings.size(), 1u);
  EXPECT_TRUE(contains(region.warnings[0].sentence, "DEM is not known")) << region.warnings[0].sentence;
  EXPECT_EQ(region.rings[0][2], (Vec2{10, 10}));
}

TEST(RegionReader, SaysWhatIsWrong) {
  TemporaryFolder folder;
  CaptureStderr();
  const std::string point = "{\"type\":\"Point\",\"coordinates\":[1,2]}";
  EXPECT_EQ(errorOf(folder.write("points.geojson", geoJson({point}))).code, ErrorCode::unsupported);
  const std::string flat = "{\"type\":\"Polygon\",\"coordinates\":[[[1,1],[1,1],[1,1],[1,1]]]}";
  EXPECT_EQ(errorOf(folder.write("flat.geojson", geoJson({flat}))).code, ErrorCode::invalidData);
  const std::string path = folder.write("hole.geojson", geoJson({kWithHole}));
  EXPECT_EQ(errorOf(path, "EPSG:nothing").code, ErrorCode::invalidData);
  RegionReadOptions options;
  options.layer = "lakes";
  EXPECT_TRUE(contains(errorOf(path, {}, options).message, "lakes"));
  EXPECT_EQ(errorOf(folder.file("absent.gpkg")).code, ErrorCode::notFound);
  EXPECT_EQ(errorOf(folder.write("empty.gpkg", "")).code, ErrorCode::unreadable);
  EXPECT_EQ(errorOf(folder.write("prose.gpkg", "once upon a time")).code, ErrorCode::unsupported);
  std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  EXPECT_EQ(readRegion(path, {}, {}, context).error().code, ErrorCode::interrupted);
  EXPECT_EQ(GetCapturedStderr(), "");
}

TEST(RegionReader, PlacesTheRealParkOnTheRealDem) {
  const std::string path = test::realData("drape/zion_boundary.gpkg"),
                    dem = test::realData("dem/srtm3_zion_cc0.tif");
  if (path.empty() || dem.empty()) GTEST_SKIP() << "the real data is not here; ARETE_DATA names its folder";
  const auto raster = readRaster(dem);
  ASSERT_TRUE(raster);
  const Georeference& g = raster->heightfield.georeference;
  const RegionRead region = readOrFail(path, g.crsWkt);
  EXPECT_TRUE(region.warnings.empty());
  for (const auto& ring : region.rings) {
    for (const Vec2& p : ring) {
      const Vec2 grid = g.toGrid(p.x, p.y);
      ASSERT_GT(grid.x, 0);
      ASSERT_LT(grid.x, raster->heightfield.columns);
      ASSERT_GT(grid.y, 0);
      ASSERT_LT(grid.y, raster->heightfield.rows);
    }
  }
  EXPECT_TRUE(isInside(region, -112.95, 37.27)) << "Angels Landing";
  EXPECT_FALSE(isInside(region, -112.53, 37.05)) << "Kanab";
}

TEST(RegionReader, TakesLinesWhereTheyAreAskedFor) {
  const TemporaryFolder folder;
  const std::string line = R"({"type":"LineString","coordinates":[[0,0],[5,0],[5,0],[5,7]]})";
  const std::string two = R"({"type":"MultiLineString","coordinates":[[[9,9],[8,9]],[[1,1],[1,2]]]})";
  const std::string path = folder.write("lines.geojson", geoJson({line, two}));
  const auto read = readRegion(path, "", {.takesLines = true});
  ASSERT_TRUE(read) << read.error().describe();
  EXPECT_TRUE(read->rings.empty());
  ASSERT_EQ(read->lines.size(), 3u);
  EXPECT_EQ(read->lines[0], (std::vector<Vec2>{{0, 0}, {5, 0}, {5, 7}})) << "repeated vertices count once";
  EXPECT_FALSE(readRegion(path, ""));
  const auto asked = readRegionArgument({path}, test::georeferenceOf("EPSG:4326"), {});
  ASSERT_FALSE(asked);
  EXPECT_TRUE(contains(asked.error().message, "`distance`")) << asked.error().describe();
  const auto corridor = readRegionArgument({path, 25}, test::georeferenceOf("EPSG:4326"), {});
  ASSERT_TRUE(corridor) << corridor.error().describe();
  EXPECT_EQ(corridor->shape.rings.size(), 3u);
  EXPECT_EQ(corridor->shape.distance, 0) << "the ground within it is in the rings";
}

TEST(RegionReader, BendsLinesAsItReprojectsThemAndLeavesThemOpen) {
  const TemporaryFolder folder;
  const std::string line = R"({"type":"LineString","coordinates":[[-118,34],[-112,34],[-112,38]]})";
  const auto read = readRegion(folder.write("line.geojson", geoJson({line})), "EPSG:32611",
                               {.crs = "EPSG:4326", .takesLines = true});
  ASSERT_TRUE(read) << read.error().describe();
  ASSERT_EQ(read->lines.size(), 1u);
  EXPECT_GT(read->lines[0].size(), 8u);
  EXPECT_GT(std::hypot(read->lines[0].back().x - read->lines[0].front().x,
                       read->lines[0].back().y - read->lines[0].front().y),
            4e5);
}

TEST(RegionReader, CoversWhatARingGoesAround) {
  const TemporaryFolder folder;
  const std::string twice =
      R"({"type":"Polygon","coordinates":[[[0,0],[9,0],[9,9],[0,9],[0,0],[9,0],[9,9],[0,9],[0,0]]]})";
  const std::string twiceAndSmaller =
      R"({"type":"Polygon","coordinates":[[[0,0],[9,0],[9,9],[0,9],[0,0],[8,1],[8,8],[1,8],[0,0]]]})";
  const std::string bowTie = R"({"type":"Polygon","coordinates":[[[0,0],[9,9],[9,0],[0,9],[0,0]]]})";
  for (const auto& [name, text] :
       {std::pair{"twice", twice}, {"smaller", twiceAndSmaller}, {"bow tie", bowTie}}) {
    const RegionRead region = readOrFail(folder.write("r.geojson", geoJson({text}, "32611")), "EPSG:32611");
    EXPECT_TRUE(isInside(region, 1.5, 4.4)) << name;
    EXPECT_TRUE(isInside(region, 8.5, 4.4)) << name;
    EXPECT_FALSE(isInside(region, 10, 4.4)) << name;
    EXPECT_TRUE(region.warnings.empty()) << name << test::joined(region.warnings);
  }
}

TEST(RegionReader, ReadsATableOfWktWithAStatedCrs) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("r.csv", "id,WKT\n1,\"POLYGON((-117 34,-116 34,-116 35,-117 34))\"\n");
  const auto georeference = test::georeferenceOf("EPSG:32611");
  const auto refused = readRegionArgument({path}, georeference, {});
  ASSERT_FALSE(refused);
  EXPECT_TRUE(contains(refused.error().message, "`region-crs`")) << refused.error().describe();
  const auto read = readRegionArgument({.text = path, .crs = "EPSG:4326"}, georeference, {});
  ASSERT_TRUE(read) << read.error().describe();
  EXPECT_NEAR(read->shape.rings.at(0).at(0).x, 500000, 1e-3) << "on the central meridian";
}

TEST(RegionReader, WarnsOfAShapeThatIsNotCutAtTheAntimeridian) {
  const TemporaryFolder folder;
  const std::string uncut =
      R"({"type":"Polygon","coordinates":[[[179,0],[-179,0],[-179,1],[179,1],[179,0]]]})";
  const std::string beyond =
      R"({"type":"Polygon","coordinates":[[[179,0],[181,0],[181,1],[179,1],[179,0]]]})";
  const std::string world =
      R"({"type":"Polygon","coordinates":[[[-180,0],[180,0],[180,1],[-180,1],[-180,0]]]})";
  for (const auto& [shape, warnings] : {std::pair{uncut, 1u}, {beyond, 0u}, {world, 0u}}) {
    const RegionRead region = readOrFail(folder.write("r.geojson", geoJson({shape})), "EPSG:4326");
    ASSERT_EQ(region.warnings.size(), warnings) << shape;
    if (warnings > 0) {
      EXPECT_TRUE(contains(region.warnings[0].sentence, "half a turn")) << region.warnings[0].sentence;
    }
  }
}

TEST(RegionReader, LeadsLinesTheShortWay) {
  const TemporaryFolder folder;
  const std::string line = R"({"type":"LineString","coordinates":[[179,60],[-179,60],[178,60],[10,60]]})";
  const std::string path = folder.write("l.geojson", geoJson({line}));
  const auto degrees = readRegion(path, "EPSG:4326", {.takesLines = true});
  ASSERT_TRUE(degrees) << degrees.error().describe();
  EXPECT_TRUE(degrees->warnings.empty());
  EXPECT_EQ(degrees->lines.at(0), (std::vector<Vec2>{{179, 60}, {181, 60}, {178, 60}, {10, 60}}));
  const auto polar = readRegion(path, "EPSG:3995", {.takesLines = true});
  ASSERT_TRUE(polar) << polar.error().describe();
  for (std::size_t i = 0; i < 4; ++i) EXPECT_GT(polar->lines.at(0).at(i).y, 3e6) << "near the antimeridian";
}

TEST(RegionReader, UnitesPolygonsThatOverlapATurnAway) {
  const TemporaryFolder folder;
  const std::string west =
      R"({"type":"Polygon","coordinates":[[[170,60],[190,60],[190,70],[170,70],[170,60]]]})";
  const std::string east =
      R"({"type":"Polygon","coordinates":[[[-180,60],[-175,60],[-175,70],[-180,70],[-180,60]]]})";
  const RegionRead region = readOrFail(folder.write("r.geojson", geoJson({west, east})), "EPSG:3413");
  OGRSpatialReference geographic, polar;
  geographic.SetFromUserInput("OGC:CRS84");
  polar.SetFromUserInput("EPSG:3413");
  polar.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  OGRCoordinateTransformation* toPolar = OGRCreateCoordinateTransformation(&geographic, &polar);
  for (const auto& [lon, isIn] : {std::pair{169.0, false},
                                  {171.0, true},
                                  {179.0, true},
                                  {-179.0, true},
                                  {-176.0, true},
                                  {-173.0, true},
                                  {-169.0, false}}) {
    double x = lon, y = 65;
    ASSERT_TRUE(toPolar->Transform(1, &x, &y));
    EXPECT_EQ(isInside(region, x, y), isIn) << lon;
  }
  OGRCoordinateTransformation::DestroyCT(toPolar);
}

}  // namespace
}  // namespace arete
