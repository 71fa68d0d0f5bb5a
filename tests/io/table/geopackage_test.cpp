// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/table/geopackage.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "io/io_fixture.h"

namespace arete {
namespace {

using test::TemporaryFolder;

std::string contentOf(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// One point with a text, a whole number and a real one.
Status fillOne(GDALDataset& dataset, const GdalErrors& errors, const std::string& crs = "EPSG:32611") {
  const auto layer = addLayer(dataset, "a", crs, wkbPoint, errors);
  if (!layer) return tl::unexpected(layer.error());
  PointAttributes values;
  values.columns = {{"t", PointAttributes::Kind::text},
                    {"i", PointAttributes::Kind::integer},
                    {"r", PointAttributes::Kind::real},
                    {"empty", PointAttributes::Kind::real}};
  for (const char* value : {"007", "-9007199254740993", "0.1", ""}) values.add(value);
  for (const auto& column : values.columns)
    if (!addField(**layer, column.name, column.kind)) return cannotBeWritten(errors);
  OGRFeature feature((*layer)->GetLayerDefn());
  int at = 0;
  setFields(feature, at, values, 0);
  EXPECT_EQ(at, 4);
  const OGRPoint point(1, 2);
  feature.SetGeometry(&point);
  if ((*layer)->CreateFeature(&feature) != OGRERR_NONE) return cannotBeWritten(errors);
  return {};
}

TEST(GeoPackage, KeepsEveryValueAndLeavesEmptyOnesUnset) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.gpkg");
  const Status written = writeGeoPackage(
      path, [](GDALDataset& dataset, GdalErrors& errors) { return fillOne(dataset, errors); });
  ASSERT_TRUE(written) << written.error().describe();
  const GdalDatasetPtr dataset = openGdal(path, GDAL_OF_VECTOR);
  ASSERT_NE(dataset, nullptr);
  OGRLayer& layer = *dataset->GetLayer(0);
  const OGRFeatureUniquePtr feature(layer.GetNextFeature());
  ASSERT_NE(feature, nullptr);
  EXPECT_STREQ(feature->GetFieldAsString("t"), "007");
  EXPECT_EQ(feature->GetFieldAsInteger64("i"), -9007199254740993) << "beyond the whole numbers of a double";
  EXPECT_EQ(feature->GetFieldAsDouble("r"), 0.1);
  EXPECT_FALSE(feature->IsFieldSetAndNotNull(feature->GetFieldIndex("empty")));
  EXPECT_NE(layer.GetSpatialRef(), nullptr);
}

TEST(GeoPackage, IsTheSameBytesOnAnyDay) {
  const TemporaryFolder folder;
  std::string first;
  for (const char* name : {"a.gpkg", "b.gpkg"}) {
    ASSERT_TRUE(writeGeoPackage(folder.file(name), [](GDALDataset& dataset, GdalErrors& errors) {
      return fillOne(dataset, errors);
    }));
    if (first.empty()) first = contentOf(folder.file(name));
    EXPECT_TRUE(contentOf(folder.file(name)) == first);
  }
  EXPECT_NE(first.find("1970-01-01T00:00:00"), std::string::npos);
  EXPECT_EQ(folder.count(), 2u) << "no journal stays";
}

TEST(GeoPackage, IsNotThereIfItCouldNotBeFilled) {
  const TemporaryFolder folder;
  const auto fails = [](GDALDataset&, GdalErrors&) -> Status {
    return failure(ErrorCode::interrupted, "stopped");
  };
  EXPECT_EQ(writeGeoPackage(folder.file("a.gpkg"), fails).error().code, ErrorCode::interrupted);
  const auto nonsense = [](GDALDataset& dataset, GdalErrors& errors) {
    return fillOne(dataset, errors, "gibberish");
  };
  EXPECT_EQ(writeGeoPackage(folder.file("a.gpkg"), nonsense).error().code, ErrorCode::usage);
  EXPECT_EQ(writeGeoPackage(folder.file("no/a.gpkg"), fails).error().code, ErrorCode::notFound);
  EXPECT_EQ(folder.count(), 0u);
}

}  // namespace
}  // namespace arete
