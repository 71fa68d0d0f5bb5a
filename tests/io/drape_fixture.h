// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures made for tests, pixel by pixel, and terrains to lay them over.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/geo/dem/raster_reader.h"
#include "io/io_fixture.h"
#include "terrain/builder/build.h"

namespace arete::test {

using Transform = std::array<double, 6>;

struct PictureSpec {
  int columns = 0, rows = 0;
  Transform transform{};
  std::string crs = {};
  int bands = 3;
  GDALDataType type = GDT_Byte;
  std::function<double(int column, int row, int band)> value = {};  ///< band from 0
  std::function<void(GDALDataset&)> adjust = {};                    ///< before the values are written
  std::vector<std::string> options = {};
};

inline std::string writePicture(const std::string& path, const PictureSpec& spec) {
  GDALAllRegister();
  CPLStringList options;
  for (const std::string& option : spec.options) options.AddString(option.c_str());
  GDALDataset* dataset = GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
      path.c_str(), spec.columns, spec.rows, spec.bands, spec.type, options.List());
  if (!spec.crs.empty()) {
    OGRSpatialReference crs;
    crs.SetFromUserInput(spec.crs.c_str());
    crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    dataset->SetSpatialRef(&crs);
  }
  Transform transform = spec.transform;
  if (transform != Transform{}) dataset->SetGeoTransform(transform.data());
  if (spec.adjust) spec.adjust(*dataset);
  std::vector<double> line(std::size_t(spec.columns));
  for (int b = 0; b < spec.bands; ++b)
    for (int row = 0; row < spec.rows; ++row) {
      for (int col = 0; col < spec.columns; ++col) line[std::size_t(col)] = spec.value(col, row, b);
      EXPECT_EQ(dataset->GetRasterBand(b + 1)->RasterIO(GF_Write, 0, row, spec.columns, 1, line.data(),
                                                        spec.columns, 1, GDT_Float64, 0, 0, nullptr),
                CE_None);
    }
  GDALClose(GDALDataset::ToHandle(dataset));
  return path;
}

/// A gentle terrain on a map.
inline TerrainModel terrainAt(const TemporaryFolder& folder, const std::string& crs,
                              const Transform& transform, int columns = 41, int rows = 33) {
  RasterSpec spec;
  spec.columns = columns;
  spec.rows = rows;
  spec.type = GDT_Float32;
  spec.crs = crs;
  spec.geoTransform = transform;
  spec.values.clear();
  for (int row = 0; row < rows; ++row)
    for (int col = 0; col < columns; ++col)
      spec.values.push_back(100 + 0.3 * col + 5 * ((row / 8 + col / 8) % 2));
  auto read = readRaster(writeRaster(folder.file("dem.tif"), spec));
  EXPECT_TRUE(read) << read.error().describe();
  auto model = build(read->heightfield);
  EXPECT_TRUE(model);
  return std::move(*model);
}

}  // namespace arete::test
