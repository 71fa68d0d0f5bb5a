// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/bindings/array_file.h"

#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>

#include <atomic>
#include <limits>
#include <memory>

#include "io/geo/crs/reader.h"

namespace arete::python {

Result<ArrayFile> ArrayFile::write(const HeightArray& array) {
  GDALAllRegister();
  constexpr auto kMost = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (array.rows > kMost || array.columns > kMost)
    return failure(ErrorCode::usage,
                   fmt::format("{} x {} heights are more than a raster has", array.rows, array.columns));
  static std::atomic<unsigned> number = 0;
  ArrayFile file(fmt::format("/vsimem/arete-array-{}.tif", ++number));
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  const char* const options[] = {"BIGTIFF=IF_SAFER", nullptr};
  const std::unique_ptr<GDALDataset> dataset(
      driver->Create(file.path_.c_str(), static_cast<int>(array.columns), static_cast<int>(array.rows), 1,
                     GDT_Float64, const_cast<char**>(options)));
  if (!dataset) return failure(ErrorCode::outOfMemory, "the array cannot be copied");
  if (array.geoTransform) {
    std::array<double, 6> transform = *array.geoTransform;
    dataset->SetGeoTransform(transform.data());
  }
  if (!array.crs.empty()) {
    const Result<OGRSpatialReference> crs = crsFromUser(array.crs);
    if (!crs) return failure(crs.error().code, crs.error().message, fmt::format("crs={}", array.crs));
    dataset->SetSpatialRef(&*crs);
  }
  GDALRasterBand* const band = dataset->GetRasterBand(1);
  band->SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
  if (!array.unit.empty()) band->SetUnitType(array.unit.c_str());
  if (band->RasterIO(GF_Write, 0, 0, static_cast<int>(array.columns), static_cast<int>(array.rows),
                     const_cast<double*>(array.heights), static_cast<int>(array.columns),
                     static_cast<int>(array.rows), GDT_Float64, 0, 0) != CE_None)
    return failure(ErrorCode::outOfMemory, "the array cannot be copied");
  return file;
}

ArrayFile::~ArrayFile() {
  if (!path_.empty()) VSIUnlink(path_.c_str());
}

}  // namespace arete::python
