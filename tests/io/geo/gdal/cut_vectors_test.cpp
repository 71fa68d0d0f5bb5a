// SPDX-License-Identifier: GPL-3.0-or-later
//
// A file of every vector format that GDAL writes is cut at many places. What is left must be refused, or give
// the features of the whole, or be warned of.
#include <cpl_string.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "io/geo/gdal/support.h"
#include "io/geo/gdal/vector_file.h"
#include "io/geo/gdal/whole_text.h"
#include "io/geo/table/feature_rows.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

namespace fs = std::filesystem;
using test::contains;
using test::joined;
using test::TemporaryFolder;

constexpr int kSide = 12;

std::string contentOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const fs::path& path, std::string_view bytes) {
  fs::remove(path);
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

/// Writes squares in a layer; an empty path where the format cannot hold them.
std::string squaresIn(GDALDriver& driver, const fs::path& folder, const char* option) {
  const GdalErrors quiet;
  fs::create_directories(folder);
  std::string extension = "dat";
  for (const char* item : {GDAL_DMD_EXTENSIONS, GDAL_DMD_EXTENSION})
    if (const char* stated = driver.GetMetadataItem(item); stated && *stated)
      extension = std::string(stated).substr(0, std::string_view(stated).find(' '));
  const std::string path = (folder / ("a." + extension)).string();
  const GdalDatasetPtr dataset(driver.Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!dataset) return {};
  OGRSpatialReference crs;
  crs.SetFromUserInput("EPSG:4326");
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  CPLStringList options;
  if (option) options.AddString(option);
  OGRLayer* layer = dataset->CreateLayer("a", &crs, wkbPolygon, options.List());
  if (!layer) return {};
  OGRFieldDefn name("name", OFTString);
  layer->CreateField(&name);
  for (int i = 0; i < kSide * kSide; ++i) {
    OGRFeature feature(layer->GetLayerDefn());
    if (layer->GetLayerDefn()->GetFieldIndex("name") >= 0)
      feature.SetField("name", std::to_string(i).c_str());
    OGRLinearRing ring;
    const double x = 15 + 0.01 * (i % kSide), y = 47 - 0.01 * (i / kSide);
    for (const auto& [dx, dy] : {std::pair{0.0, 0.0}, {0.005, 0.0}, {0.005, 0.005}, {0.0, 0.0}})
      ring.addPoint(x + dx, y + dy);
    OGRPolygon polygon;
    polygon.addRing(&ring);
    feature.SetGeometry(&polygon);
    if (layer->CreateFeature(&feature) != OGRERR_NONE) return {};
  }
  return path;
}

/// All features as a text. Errors: those of the readers.
Result<std::string> featuresOf(const std::string& path, Warnings& warnings) {
  GdalErrors errors;
  const auto dataset = openVectors(path, "set of polygons", errors, warnings);
  if (!dataset) return tl::unexpected(dataset.error());
  std::string text;
  for (OGRLayer* layer : (*dataset)->GetLayers()) {
    const Status read = forFeatures(**dataset, *layer, errors, {}, [&](OGRFeature& feature) -> Status {
      char* wkt = nullptr;
      if (const OGRGeometry* geometry = feature.GetGeometryRef()) geometry->exportToWkt(&wkt);
      text += wkt ? wkt : "none";
      CPLFree(wkt);
      for (int i = 0; i < feature.GetFieldCount(); ++i) text += ';' + fieldText(feature, i);
      text += '\n';
      return {};
    });
    if (!read) return tl::unexpected(read.error());
  }
  errors.moveTo(warnings);
  return text;
}

TEST(CutVectors, OfEveryFormatAreRefusedWholeOrWarnedOf) {
  registerGdal();
  const TemporaryFolder folder;
  int formats = 0;
  GDALDriverManager& drivers = *GetGDALDriverManager();
  for (int d = 0; d < drivers.GetDriverCount(); ++d) {
    GDALDriver& driver = *drivers.GetDriver(d);
    const std::string name = driver.GetDescription();
    const auto can = [&](const char* item) { return driver.GetMetadataItem(item) != nullptr; };
    if (!can(GDAL_DCAP_VECTOR) || !can(GDAL_DCAP_CREATE)) continue;
    // In memory, on servers, of several files of which some are caches, of pages, tables of rows that may end
    // anywhere.
    constexpr std::string_view kOthers[] = {"MEM",     "Memory", "PGDUMP", "PDF", "OpenFileGDB", "MVT",
                                            "MBTiles", "PDS4",   "XLSX",   "ODS", "Selafin",     "netCDF"};
    if (std::ranges::find(kOthers, name) != std::end(kOthers)) continue;
    std::vector<const char*> options = {nullptr};
    if (name == "CSV") options = {"GEOMETRY=AS_WKT"};
    if (name == "FlatGeobuf") options = {nullptr, "SPATIAL_INDEX=NO"};
    if (name == "GeoJSONSeq") options = {nullptr, "RS=YES"};
    for (std::size_t o = 0; o < options.size(); ++o) {
      const fs::path own = folder.file(name + std::to_string(o));
      const std::string path = squaresIn(driver, own, options[o]);
      if (path.empty()) continue;
      Warnings said;
      const auto whole = featuresOf(path, said);
      if (!whole || whole->empty()) continue;
      ++formats;
      fs::path largest;
      for (const auto& entry : fs::directory_iterator(own))
        if (entry.is_regular_file() && (largest.empty() || entry.file_size() > fs::file_size(largest)))
          largest = entry.path();
      const std::string bytes = contentOf(largest);
      for (const double part : {0.25, 0.4, 0.5, 0.6, 0.75, 0.9, 0.97, 0.99, 0.999}) {
        const auto left = std::size_t(double(bytes.size()) * part);
        write(largest, std::string_view(bytes).substr(0, left));
        Warnings warnings;
        const auto cut = featuresOf(path, warnings);
        if (cut && *cut != *whole) {
          EXPECT_FALSE(warnings.empty()) << name << " cut to " << left << " of " << bytes.size()
                                         << " bytes: " << std::count(cut->begin(), cut->end(), '\n');
        }
        EXPECT_FALSE(contains(joined(warnings) + (cut ? "" : cut.error().describe()), "0x"))
            << joined(warnings) << (cut ? "" : cut.error().describe());
      }
      write(largest, bytes);
    }
  }
  EXPECT_GE(formats, 16);
}

std::string recordsOf(int count, const std::string& before, const std::string& after) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text +=
        before +
        R"({"type":"Feature","properties":{"n":"a \"}{\" b"},"geometry":{"type":"Point","coordinates":[15.)" +
        std::to_string(i) + ",47,1" + std::to_string(i) + "]}}" + after;
  return text;
}

TEST(CutVectors, OfAGeoJsonTextSequenceNameTheBrokenRecord) {
  registerGdal();
  const TemporaryFolder folder;
  for (const auto& [before, after] : {std::pair<std::string, std::string>{"", "\n"},
                                      {"\x1e", "\n"},
                                      {"\x1e", ""},
                                      {"", "\r\n"},
                                      {"\x1e\n", "\n\n"}}) {
    const std::string whole = recordsOf(40, before, after);
    Warnings warnings;
    EXPECT_TRUE(checkWholeText(folder.write("w.geojsonl", whole), "GeoJSONSeq", warnings));
    const std::size_t last = whole.rfind('{', whole.rfind("\"type\":\"Feature\""));
    const std::size_t end = whole.rfind('}') + 1;
    for (std::size_t length = last + 1; length < end; ++length) {
      const Status cut =
          checkWholeText(folder.write("c.geojsonl", whole.substr(0, length)), "GeoJSONSeq", warnings);
      ASSERT_FALSE(cut) << length;
      EXPECT_EQ(cut.error().code, ErrorCode::corrupt);
      EXPECT_TRUE(contains(cut.error().message, "record 40")) << cut.error().message;
    }
    EXPECT_TRUE(checkWholeText(folder.write("c.geojsonl", whole.substr(0, end)), "GeoJSONSeq", warnings));
  }
}

TEST(CutVectors, OfAGeoJsonTextSequenceMayBeDamagedAnywhere) {
  const TemporaryFolder folder;
  const std::string one = recordsOf(1, "", "\n");
  struct Case {
    std::string text;
    bool isWhole;
  };
  for (const Case& c : {
           Case{one + one + one, true},
           Case{one + "\n\n" + one, true},
           Case{"\xef\xbb\xbf" + one, true},
           Case{one + "   \n", true},
           Case{"{\"a\": NaN}\n" + one, true},
           Case{one + one.substr(0, 20) + "\n" + one, false},
           Case{one + "}\n" + one, false},
           Case{one + "null\n", false},
           Case{one + "{\"a\": \"b}\n" + one, false},
           Case{one.substr(0, one.size() - 1) + one, false},
           Case{one + "[1,2]\n", false},
           Case{"{\n}\n", false},
           Case{"\x1e{\n}\n\x1e{\n\"a\": [\n1]}\n", true},
           Case{"\x1e{\n}\n\x1e{\n\"a\": [\n1}\n\x1e", false},
           Case{"", true},
           Case{"\n\n", true},
           Case{one + "{", false},
           Case{one + "{\"a\\\"}", false},
       }) {
    Warnings warnings;
    const Status status = checkWholeText(folder.write("a.geojsonl", c.text), "GeoJSONSeq", warnings);
    EXPECT_EQ(bool(status), c.isWhole) << c.text;
  }
}

TEST(CutVectors, OfATableEndInItsQuotes) {
  const TemporaryFolder folder;
  Warnings warnings;
  EXPECT_TRUE(
      checkWholeText(folder.write("a.csv", "WKT,n\n\"POLYGON ((0 0,1 0,1 1,0 0))\",\"a \"\"b\"\"\n c\"\n"),
                     "CSV", warnings));
  const Status cut =
      checkWholeText(folder.write("a.csv", "WKT,n\n\"POINT (1 2)\",a\n\"POLYGON ((0 0,1 0"), "CSV", warnings);
  ASSERT_FALSE(cut);
  EXPECT_TRUE(contains(cut.error().message, "line 3")) << cut.error().message;
  EXPECT_TRUE(warnings.empty());
  EXPECT_TRUE(checkWholeText(folder.write("a.gmt", "# @VGMT1.0\n>\n1 2\n1"), "OGR_GMT", warnings));
  EXPECT_EQ(warnings.size(), 1u);
}

}  // namespace
}  // namespace arete
