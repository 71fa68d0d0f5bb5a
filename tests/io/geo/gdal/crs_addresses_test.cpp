// SPDX-License-Identifier: GPL-3.0-or-later
//
// A server counts the requests that files of many formats make, whose texts of CRSs and schemas are
// addresses.
#include "io/geo/gdal/crs_addresses.h"

#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <map>
#include <string>
#include <vector>

#include "io/geo/crs/reader.h"
#include "io/geo/gdal/support.h"
#include "io/geo/table/point_table.h"
#include "io/georeference_fixture.h"
#include "io/http_server.h"
#include "io/io_fixture.h"
#include "io/query/extract/region_reader.h"

namespace arete {
namespace {

using test::HttpServer;
using test::TemporaryFolder;

std::string collection(const std::string& crs, const char* coordinates = "[1,2]",
                       const char* type = "Point") {
  return R"({"type":"FeatureCollection","crs":)" + crs +
         R"(,"features":[{"type":"Feature","properties":{},"geometry":{"type":")" + type +
         R"(","coordinates":)" + coordinates + "}}]}";
}

constexpr const char* kSchema = "wfs?service=WFS&version=1.1.0&request=DescribeFeatureType&typeName=ogr:p";

TEST(CrsAddresses, InFilesAreNotFetched) {
  registerGdal();
  HttpServer server(std::map<std::string, std::string>{{"x", "LOCAL_CS[\"fetched\"]"}, {kSchema, "<a/>"}});
  const std::string url = server.address("x");
  const auto link = [&](const char* type, const char* key) {
    return std::string(R"({"type":")") + type + R"(","properties":{")" + key + "\":\"" + url + "\"}}";
  };
  const std::string wfs =
      "<?xml version=\"1.0\"?><wfs:FeatureCollection xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
      "xmlns:wfs=\"http://www.opengis.net/wfs\" xmlns:ogr=\"http://ogr.maptools.org/\" "
      "xmlns:gml=\"http://www.opengis.net/gml\" xsi:schemaLocation=\"http://ogr.maptools.org/ " +
      server.address("wfs") +
      "?service=WFS&amp;version=1.1.0&amp;request=DescribeFeatureType&amp;typeName=ogr:p\"><gml:"
      "featureMember><ogr:p>"
      "<ogr:g><gml:Point srsName=\"" +
      url +
      "\"><gml:pos>1 2</gml:pos></gml:Point></ogr:g></ogr:p>"
      "</gml:featureMember></wfs:FeatureCollection>";
  struct Case {
    const char* name;
    std::string content;
  };
  TemporaryFolder folder;
  folder.write("p.prj", url);
  folder.write("p.csvt", "Real,Real,WKT");
  for (const Case& c : {
           Case{"link.geojson", collection(link("link", "href"))},
           Case{"name.geojson", collection(link("name", "name"))},
           Case{"url.geojson", collection(link("url", "url"))},
           Case{"URL.geojson", collection(link("URL", "URL"))},
           Case{"epsg.geojson", collection(link("epsg", "code"))},
           Case{"line.geojsonl", R"({"type":"Feature","crs":)" + link("link", "href") +
                                     R"(,"properties":{},"geometry":{"type":"Point","coordinates":[1,2]}})"
                                     "\n"},
           Case{"nested.geojson", R"({"type":"Feature","crs":)" + link("link", "href") +
                                      R"(,"properties":{},"geometry":{"type":"Point","coordinates":[1,2]}})"},
           Case{"geometry.geojson",
                R"({"type":"Point","crs":)" + link("link", "href") + R"(,"coordinates":[1,2]})"},
           Case{"esri.json",
                R"({"geometryType":"esriGeometryPoint","spatialReference":{"wkt":")" + url +
                    R"("},"fields":[],"features":[{"attributes":{},"geometry":{"x":1,"y":2}}]})"},
           Case{"topo.json", R"({"type":"Topology","crs":)" + link("link", "href") +
                                 R"(,"objects":{"a":{"type":"Point","coordinates":[1,2]}},"arcs":[]})"},
           Case{"schema.gml", wfs},
           Case{"p.csv", "x,y,WKT\n1,2,POINT (1 2)\n"},
           Case{"k.kml",
                "<kml xmlns=\"http://www.opengis.net/kml/2.2\"><Document><NetworkLink><Link><href>" + url +
                    "</href></Link></NetworkLink><Placemark><Point><coordinates>1,2</coordinates></Point>"
                    "</Placemark></Document></kml>"},
           Case{"g.gpx",
                "<gpx version=\"1.1\" creator=\"x\" xmlns=\"http://www.topografix.com/GPX/1/1\" "
                "xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" xsi:schemaLocation=\"a " +
                    url + "\"><wpt lat=\"1\" lon=\"2\"/></gpx>"},
       }) {
    const std::string path = folder.write(c.name, c.content);
    readPointTable(path, {});
    const GdalErrors quiet;
    if (const GdalDatasetPtr dataset = openGdal(path, GDAL_OF_VECTOR))
      for (OGRLayer* layer : dataset->GetLayers())
        for (const auto& feature : *layer) (void)feature->GetGeometryRef();
    EXPECT_EQ(server.requests("x") + server.requests(kSchema), 0) << c.name;
  }
  const std::string region = folder.write(
      "region.geojson", collection(link("link", "href"), "[[[0,0],[1,0],[1,1],[0,0]]]", "Polygon"));
  readRegion(region, "EPSG:4326");
  EXPECT_EQ(server.requests("x"), 0);
}

TEST(CrsAddresses, OfAPersonAreFetchedAlsoWhileAFileIsRead) {
  registerGdal();
  HttpServer server(std::map<std::string, std::string>{
      {"crs",
       "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],"
       "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]]"}});
  const GdalErrors quiet;
  const auto crs = crsFromUser(server.address("crs"));
  EXPECT_TRUE(crs) << crs.error().describe();
  EXPECT_EQ(server.requests("crs"), 1);
}

TEST(CrsAddresses, DoNotKeepFilesFromBeingRead) {
  registerGdal();
  HttpServer server(std::map<std::string, std::string>{{"a.geojson", collection("null")}});
  const auto table = readPointTable(server.address("a.geojson"), test::georeferenceOf("EPSG:4326"));
  EXPECT_TRUE(table) << table.error().describe();
}

}  // namespace
}  // namespace arete
