// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of io/ share: a folder that goes away, small rasters made with GDAL, the real data where it
// is.
#pragma once

#include <cpl_string.h>
#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sentences_of.h"

namespace arete::test {

/// A folder of the test's own, removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "arete-io-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    // Cutting an old file to zero length makes some file systems wait for the disk.
    std::filesystem::remove(path_ / name);
    std::ofstream(path_ / name, std::ios::binary) << text;
    return file(name);
  }
  std::size_t count() const {
    return std::size_t(
        std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator{}));
  }

 private:
  std::filesystem::path path_;
};

struct RasterSpec {
  int columns = 3;
  int rows = 2;
  int bands = 1;
  GDALDataType type = GDT_Int16;
  std::vector<double> values = {1, 2, 3, 4, 5, 6};  ///< of each band
  std::string crs = "EPSG:32611";
  std::optional<std::array<double, 6>> geoTransform = std::array<double, 6>{500000, 30, 0, 4000000, 0, -30};
  std::string driver = "GTiff";
  std::vector<std::string> options;          ///< of creation, "NAME=value"
  std::function<void(GDALDataset&)> adjust;  ///< before the values are written
};

/// Writes a small raster and returns its path.
inline std::string writeRaster(const std::string& path, const RasterSpec& spec) {
  GDALAllRegister();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(spec.driver.c_str());
  CPLStringList options;
  for (const std::string& option : spec.options) options.AddString(option.c_str());
  GDALDataset* dataset =
      driver->Create(path.c_str(), spec.columns, spec.rows, spec.bands, spec.type, options.List());
  if (!spec.crs.empty()) {
    OGRSpatialReference crs;
    crs.SetFromUserInput(spec.crs.c_str());
    crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    dataset->SetSpatialRef(&crs);
  }
  if (spec.geoTransform) {
    auto transform = *spec.geoTransform;
    dataset->SetGeoTransform(transform.data());
  }
  if (spec.adjust) spec.adjust(*dataset);
  std::vector<double> values = spec.values;
  for (int band = 1; band <= spec.bands; ++band) {
    const CPLErr status =
        dataset->GetRasterBand(band)->RasterIO(GF_Write, 0, 0, spec.columns, spec.rows, values.data(),
                                               spec.columns, spec.rows, GDT_Float64, 0, 0, nullptr);
    EXPECT_EQ(status, CE_None);
  }
  GDALClose(GDALDataset::ToHandle(dataset));
  return path;
}

/// Where the real data is ($ARETE_DATA, or the folder shared/data beside the repository); empty if nowhere.
inline std::filesystem::path realDataFolder() {
  if (const char* stated = std::getenv("ARETE_DATA")) return stated;
  const std::filesystem::path repository =
      std::filesystem::path(__FILE__).parent_path().parent_path().parent_path();
  const std::filesystem::path beside = repository.parent_path() / "shared" / "data";
  return std::filesystem::exists(beside) ? beside : std::filesystem::path();
}

/// The path of a file of the real data; empty if it is not there.
inline std::string realData(const std::string& name) {
  const std::filesystem::path path = realDataFolder() / name;
  return std::filesystem::exists(path) && !realDataFolder().empty() ? path.string() : std::string();
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

inline std::string joined(const std::vector<std::string>& sentences) {
  std::string all;
  for (const std::string& sentence : sentences) all += sentence + "\n";
  return all;
}
inline std::string joined(const Warnings& warnings) {
  return joined(sentencesOf(warnings));
}

}  // namespace arete::test
