// SPDX-License-Identifier: GPL-3.0-or-later
//
// The file decides, not its name, except for text: a raster driver that recognises it makes it a raster,
// unless that is GDAL's "XYZ", which takes any text of numbers for one, or a container (GeoPackage, ...) that
// turns out to hold no raster. Text and vector layers are points.
#include "io/dem_reader.h"

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <string_view>
#include <utility>

#include "io/gdal_support.h"
#include "io/gridded_points.h"
#include "io/point_text.h"
#include "io/zipped_raster.h"

namespace arete {
namespace {

bool isPointCloud(const std::string& path) {
  constexpr std::array<std::string_view, 3> kExtensions = {"las", "laz", "e57"};
  if (std::find(kExtensions.begin(), kExtensions.end(), lowerExtension(path)) != kExtensions.end())
    return true;
  std::array<char, 4> magic{};
  VSILFILE* file = VSIFOpenL(path.c_str(), "rb");
  if (!file) return false;
  const bool whole = VSIFReadL(magic.data(), 1, magic.size(), file) == magic.size();
  VSIFCloseL(file);
  return whole && std::memcmp(magic.data(), "LASF", magic.size()) == 0;
}

/// What the file is, as far as GDAL's raster drivers can tell.
bool isRaster(const std::string& path, bool& opensAsVector) {
  GdalErrors quiet;
  GDALDriverH driver = GDALIdentifyDriverEx(path.c_str(), GDAL_OF_RASTER, nullptr, nullptr);
  const bool identified = driver && !EQUAL(GDALGetDriverShortName(driver), "XYZ");
  if (identified) {
    const GdalDatasetPtr dataset = openGdal(path, GDAL_OF_RASTER);
    if (dataset && (dataset->GetRasterCount() > 0 || dataset->GetMetadata("SUBDATASETS"))) return true;
  }
  opensAsVector = openGdal(path, GDAL_OF_VECTOR) != nullptr;
  return identified && !opensAsVector;
}

Result<DemRead> readAsRaster(const std::string& path, const DemReadOptions& options,
                             const RunContext& context) {
  RasterReadOptions rasterOptions;
  rasterOptions.band = options.band;
  rasterOptions.crs = options.crs;
  rasterOptions.nodata = options.nodata;
  auto read = readRaster(path, rasterOptions, context);
  if (!read) return tl::unexpected(read.error());
  return DemRead{std::move(read->heightfield), std::move(read->warnings)};
}

Result<DemRead> readAsPoints(const std::string& path, bool text, const DemReadOptions& options,
                             const RunContext& context) {
  PointReadOptions pointOptions;
  pointOptions.layer = options.layer;
  pointOptions.zField = options.zField;
  pointOptions.crs = options.crs;
  pointOptions.nodata = options.nodata;
  auto read = readPoints(path, pointOptions, context);
  if (!read) return tl::unexpected(read.error());
  if (text) {
    if (auto raster = asRaster(read->heightfield)) {
      read->warnings.push_back(
          fmt::format("the points fill a grid of {} columns and {} rows: read as a raster", raster->columns,
                      raster->rows));
      return DemRead{std::move(*raster), std::move(read->warnings)};
    }
  }
  return DemRead{std::move(read->heightfield), std::move(read->warnings)};
}

Result<DemRead> readFrom(const std::string& path, const DemReadOptions& options, const RunContext& context) {
  registerGdal();
  if (isPointCloud(path))
    if (VSIStatBufL status; VSIStatL(path.c_str(), &status) == 0)
      return failure(
          ErrorCode::unsupported,
          "is a point cloud, which is not read; make a DEM of it first, or a text of its ground points, for "
          "instance with PDAL: pdal translate IN.laz ground.csv -f filters.range "
          "--filters.range.limits='Classification[2:2]'",
          path);
  if (isPlainZip(path)) return readAsRaster(path, options, context);
  bool opensAsVector = false;
  if (isRaster(path, opensAsVector)) return readAsRaster(path, options, context);

  GdalErrors errors;
  if (auto problem = findInputProblem(path)) return tl::unexpected(*problem);
  const bool text = looksLikePointText(path);
  if (text || opensAsVector) return readAsPoints(path, text, options, context);
  openGdal(path, GDAL_OF_RASTER | GDAL_OF_VECTOR);
  return tl::unexpected(explainOpenFailure(path, "DEM", errors));
}

}  // namespace

Result<DemRead> readDem(const std::string& path, const DemReadOptions& options, const RunContext& context) {
  try {
    return readFrom(path, options, context);
  } catch (const std::bad_alloc&) {
    return failure(ErrorCode::unsupported, "is larger than the memory that is free", path);
  }
}

}  // namespace arete
