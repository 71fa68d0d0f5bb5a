// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "gis/driver/register.h"
#include "io/io_fixture.h"
#include "io/store/amt/file.h"
#include "terrain/builder/build.h"

namespace arete::test {

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, CloseDataset>;

/// Models in a folder of the test's own, opened by the driver.
class DriverFixture : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    GDALAllRegister();
    registerAmtDriver();
  }

  /// @param height by source coordinates
  std::string terrain(const std::string& name, std::uint32_t columns, std::uint32_t rows,
                      const std::function<double(double, double)>& height,
                      const std::array<double, 6>& geoTransform = {500000, 30, 0, 4000000, 0, -30}) const {
    RasterHeightfield field;
    field.columns = columns;
    field.rows = rows;
    field.source = "/somewhere/dem.tif";
    field.georeference.geoTransform = geoTransform;
    field.georeference.hasGeoTransform = true;
    OGRSpatialReference crs;
    crs.importFromEPSG(32611);
    char* wkt = nullptr;
    crs.exportToWkt(&wkt);
    field.georeference.crsWkt = wkt;
    CPLFree(wkt);
    field.georeference.verticalUnit = "metre";
    for (std::uint32_t row = 0; row < rows; ++row)
      for (std::uint32_t column = 0; column < columns; ++column) {
        const Vec2 p = field.georeference.toSource(column, row);
        field.heights.push_back(height(p.x, p.y));
      }
    return written(name, build(field));
  }
  std::string written(const std::string& name, const Result<TerrainModel>& model,
                      bool isPacked = false) const {
    EXPECT_TRUE(model) << (model ? "" : model.error().message);
    EXPECT_TRUE(writeAmt(folder_.file(name), *model, {}, {.isPacked = isPacked}));
    return folder_.file(name);
  }

  /// Null, and a message, where it cannot be opened.
  Dataset open(const std::string& path, std::initializer_list<const char*> options = {},
               unsigned flags = GDAL_OF_RASTER | GDAL_OF_VECTOR) {
    CPLStringList list;
    for (const char* const option : options) list.AddString(option);
    const char* const drivers[] = {"AMT", nullptr};
    CPLErrorReset();
    CPLPushErrorHandler(CPLQuietErrorHandler);
    Dataset dataset(GDALDataset::Open(path.c_str(), flags, drivers, list.List(), nullptr));
    CPLPopErrorHandler();
    message_ = CPLGetLastErrorMsg();
    return dataset;
  }
  const std::string& message() const { return message_; }
  const TemporaryFolder& folder() const { return folder_; }

  static double plane(double x, double y) { return 3 + (x - 500000) / 7 - (y - 4000000) / 11; }
  static double hills(double x, double y) {
    return 100 * std::sin(x / 300) * std::cos(y / 400) + (x - 500000) / 50;
  }

 private:
  TemporaryFolder folder_;
  std::string message_;
};

}  // namespace arete::test
