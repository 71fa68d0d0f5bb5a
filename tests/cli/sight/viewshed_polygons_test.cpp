// SPDX-License-Identifier: GPL-3.0-or-later
// arete viewshed --polygons, and the colours of its raster.
#include <fmt/format.h>
#include <gdal_alg.h>
#include <gdal_priv.h>
#include <gdal_utils.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cli/sight_fixture.h"
#include "io/geo/dem/raster_reader.h"

namespace arete::cli_test {
namespace {

struct Closer {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, Closer>;

class ViewshedPolygons : public SightCommands {
 protected:
  void SetUp() override {
    SightCommands::SetUp();
    GDALAllRegister();
  }
  Dataset open(const std::string& name, unsigned flags) const {
    return Dataset(GDALDataset::Open(path(name).c_str(), flags));
  }
  std::vector<double> valuesOf(GDALDataset& raster) const {
    GDALRasterBand& band = *raster.GetRasterBand(1);
    std::vector<double> values(std::size_t(band.GetXSize()) * std::size_t(band.GetYSize()));
    EXPECT_EQ(band.RasterIO(GF_Read, 0, 0, band.GetXSize(), band.GetYSize(), values.data(), band.GetXSize(),
                            band.GetYSize(), GDT_Float64, 0, 0, nullptr),
              CE_None);
    return values;
  }
  const std::vector<std::string> question_ = {"viewshed",          "dem.amt",         "--observer",
                                              "500105,5199895,20", "--target-height", "2"};
  std::vector<std::string> with(const std::vector<std::string>& more) const {
    std::vector<std::string> words = question_;
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
};

TEST_F(ViewshedPolygons, AreTheRasterAgainWhenGdalBurnsThem) {
  makeModel("EPSG:32632");
  const Outcome outcome = run(with({"-o", "seen.tif", "--polygons", "seen.gpkg", "--json"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Dataset raster = open("seen.tif", GDAL_OF_RASTER), vectors = open("seen.gpkg", GDAL_OF_VECTOR);
  ASSERT_TRUE(raster && vectors);
  OGRLayer* const layer = vectors->GetLayerByName("viewshed");
  ASSERT_NE(layer, nullptr);
  ASSERT_NE(layer->GetSpatialRef(), nullptr);
  EXPECT_STREQ(layer->GetSpatialRef()->GetAuthorityCode(nullptr), "32632");
  EXPECT_EQ(outcome.json()["polygons"]["count"], layer->GetFeatureCount());

  const std::vector<double> values = valuesOf(*raster);
  const int columns = raster->GetRasterXSize(), rows = raster->GetRasterYSize();
  const Dataset burnt(
      GetGDALDriverManager()->GetDriverByName("MEM")->Create("", columns, rows, 1, GDT_Byte, nullptr));
  std::array<double, 6> transform;
  ASSERT_EQ(raster->GetGeoTransform(transform.data()), CE_None);
  burnt->SetGeoTransform(transform.data());
  burnt->SetSpatialRef(raster->GetSpatialRef());
  burnt->GetRasterBand(1)->Fill(1);  // NODATA of the answer
  int bands[] = {1};
  OGRLayerH layers[] = {OGRLayer::ToHandle(layer)};
  const char* options[] = {"ATTRIBUTE=value", nullptr};
  ASSERT_EQ(GDALRasterizeLayers(GDALDataset::ToHandle(burnt.get()), 1, bands, 1, layers, nullptr, nullptr,
                                nullptr, const_cast<char**>(options), nullptr, nullptr),
            CE_None);
  EXPECT_EQ(valuesOf(*burnt), values);

  std::map<std::string, double> cells, areas;
  layer->ResetReading();
  for (const auto& feature : layer) {
    EXPECT_TRUE(feature->GetGeometryRef()->IsValid());
    const std::string answer = feature->GetFieldAsString("answer");
    const int value = feature->GetFieldAsInteger("value");
    EXPECT_EQ(value, answer == "seen" ? 255 : answer == "hidden" ? 0 : answer == "unknown" ? 100 : -1);
    cells[answer] += double(feature->GetFieldAsInteger64("cells"));
    areas[answer] += feature->GetFieldAsDouble("area_m2");
  }
  for (const char* answer : {"seen", "hidden", "unknown"}) {
    EXPECT_EQ(cells[answer], outcome.json()[answer].get<double>()) << answer;
    // 100 square metres a cell on the map, whose scale in the middle of the zone is 0.9996.
    EXPECT_NEAR(areas[answer], cells[answer] * 100 / (0.9996 * 0.9996), 1e-5 * areas[answer] + 1e-9)
        << answer;
  }
}

TEST_F(ViewshedPolygons, StandAloneAndKeepOtherLayers) {
  makeModel("EPSG:32632");
  const Outcome alone = run(with({"--polygons", "seen.gpkg"}));
  ASSERT_EQ(alone.code, 0) << alone.err;
  EXPECT_NE(alone.out.find("seen.gpkg: "), std::string::npos) << alone.out;
  EXPECT_EQ(files(), (std::set<std::string>{"dem.amt", "dem.tif", "seen.gpkg"}));
  ASSERT_EQ(run({"extract", "dem.amt", "-o", "seen.gpkg", "--max-error", "1", "-q"}).code, 0);
  ASSERT_EQ(run(with({"--polygons", "seen.gpkg", "-q"})).code, 0);
  EXPECT_EQ(open("seen.gpkg", GDAL_OF_VECTOR)->GetLayerCount(), 2);
  ASSERT_EQ(run(with({"--polygons", "seen.gpkg", "--overwrite", "-q"})).code, 0);
  EXPECT_EQ(open("seen.gpkg", GDAL_OF_VECTOR)->GetLayerCount(), 1);
}

TEST_F(ViewshedPolygons, OfSeveralObserversHaveOneValueEach) {
  makeModel("EPSG:32632");
  for (const char* mode : {"count", "server"}) {
    const Outcome outcome = run(with({"--observer", "500505,5199895,20", "--mode", mode, "-o", "many.tif",
                                      "--polygons", "many.gpkg", "--overwrite", "--json"}));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::vector<double> values = valuesOf(*open("many.tif", GDAL_OF_RASTER));
    std::map<int, std::int64_t> raster, polygons;
    for (const double value : values)
      if (value < 65533) ++raster[int(value)];
    const Dataset vectors = open("many.gpkg", GDAL_OF_VECTOR);
    for (const auto& feature : vectors->GetLayer(0)) {
      if (!feature->IsFieldSetAndNotNull(feature->GetFieldIndex(mode))) continue;
      polygons[feature->GetFieldAsInteger(mode)] += feature->GetFieldAsInteger64("cells");
      EXPECT_STREQ(feature->GetFieldAsString("answer"),
                   feature->GetFieldAsInteger(mode) > 0 ? "seen" : "hidden");
    }
    EXPECT_EQ(polygons, raster) << mode;
  }
}

TEST_F(ViewshedPolygons, WithoutACrsHaveNoAreas) {
  makeModel();
  const Outcome outcome = run(
      {"viewshed", "dem.amt", "--observer", "1105,1895,20", "--earth", "plane", "--polygons", "seen.gpkg"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("areas are left out"), std::string::npos) << outcome.err;
  const Dataset vectors = open("seen.gpkg", GDAL_OF_VECTOR);
  for (const auto& feature : vectors->GetLayer(0))
    EXPECT_FALSE(feature->IsFieldSetAndNotNull(feature->GetFieldIndex("area_m2")));
}

TEST_F(ViewshedPolygons, AreRefusedWhereTheyMeanNothing) {
  makeModel();
  const std::vector<std::string> base = {"viewshed", "dem.amt", "--observer", "1105,1895,20"};
  const auto words = [&](std::vector<std::string> more) {
    more.insert(more.begin(), base.begin(), base.end());
    return more;
  };
  refused(words({}), 2, "--output is required, or --polygons");
  refused(words({"--polygons", "x.shp"}), 2, "end in .gpkg");
  refused(words({"--polygons", "x.gpkg", "--mode", "height"}), 2, "--mode seen, count or server");
  refused(words({"--polygons", "x.gpkg", "-o", "x.gpkg"}), 2, ".tif");
  EXPECT_EQ(files(), (std::set<std::string>{"dem.amt", "dem.tif"}));
}

TEST_F(ViewshedPolygons, LeaveNothingBehindWhereTheyCannotBeWritten) {
  makeModel("EPSG:32632");
  write("seen.gpkg", "no GeoPackage");
  const Outcome outcome = run(with({"-o", "seen.tif", "--polygons", "seen.gpkg"}));
  EXPECT_NE(outcome.code, 0);
  EXPECT_EQ(read("seen.gpkg"), "no GeoPackage");
  EXPECT_FALSE(exists("seen.tif"));
}

TEST_F(ViewshedPolygons, AndTheirRasterHasColoursThatChangeNoValue) {
  makeModel("EPSG:32632");
  ASSERT_EQ(run(with({"-o", "seen.tif", "-q"})).code, 0);
  EXPECT_FALSE(exists("seen.tif.aux.xml"));
  const Dataset raster = open("seen.tif", GDAL_OF_RASTER);
  GDALRasterBand& band = *raster->GetRasterBand(1);
  EXPECT_EQ(band.GetColorInterpretation(), GCI_PaletteIndex);
  EXPECT_EQ(band.GetNoDataValue(), 1);
  const GDALColorTable* const table = band.GetColorTable();
  ASSERT_NE(table, nullptr);
  const auto colorOf = [&](int value) {
    const GDALColorEntry& entry = *table->GetColorEntry(value);
    return std::array{entry.c1, entry.c2, entry.c3, entry.c4};
  };
  EXPECT_EQ(colorOf(255), (std::array<short, 4>{26, 152, 80, 255}));
  EXPECT_EQ(colorOf(0)[0], 189);
  EXPECT_EQ(colorOf(1)[3], 0) << "NODATA is transparent";
  // Copies that GDAL makes keep values and colours.
  const char* words[] = {"-q", "-of", "PNG", nullptr};
  GDALTranslateOptions* const options = GDALTranslateOptionsNew(const_cast<char**>(words), nullptr);
  const Dataset copy(GDALDataset::FromHandle(
      GDALTranslate(path("copy.png").c_str(), GDALDataset::ToHandle(raster.get()), options, nullptr)));
  GDALTranslateOptionsFree(options);
  ASSERT_TRUE(copy);
  EXPECT_EQ(valuesOf(*copy), valuesOf(*raster));
  EXPECT_NE(copy->GetRasterBand(1)->GetColorTable(), nullptr);
  // Other rasters have none: QGIS would list 65 536 colours of a count.
  for (const char* mode : {"count", "height", "horizon"}) {
    ASSERT_EQ(run(with({"--mode", mode, "-o", "other.tif", "-q"})).code, 0);
    EXPECT_EQ(open("other.tif", GDAL_OF_RASTER)->GetRasterBand(1)->GetColorTable(), nullptr) << mode;
  }
}

}  // namespace
}  // namespace arete::cli_test
