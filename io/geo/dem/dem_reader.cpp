// SPDX-License-Identifier: GPL-3.0-or-later
//
// The content of a file decides what it is, not its name, except for text. A file that a raster driver
// identifies is a raster, unless the driver is GDAL's "XYZ", which accepts any text of numbers, or the file
// is a container (GeoPackage, ...) without a raster. Texts and vector layers are points.
#include "io/geo/dem/dem_reader.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/files/text/address_text.h"
#include "io/files/text_scan.h"
#include "io/geo/crs/map_scale.h"
#include "io/geo/dem/declared_length.h"
#include "io/geo/dem/dem_files.h"
#include "io/geo/dem/gridded_points.h"
#include "io/geo/dem/seam_column.h"
#include "io/geo/gdal/file_length.h"
#include "io/geo/gdal/support.h"
#include "io/geo/gdal/zipped_raster.h"
#include "io/geo/network/network_path.h"
#include "io/geo/network/network_reading.h"
#include "io/geo/text/point_text.h"
#include "terrain/model/lone_heights.h"

namespace arete {
namespace {

bool isPointCloud(const std::string& path) {
  const GdalErrors quiet;
  constexpr std::array<std::string_view, 3> kExtensions = {"las", "laz", "e57"};
  if (std::find(kExtensions.begin(), kExtensions.end(), text::lowerExtension(path)) != kExtensions.end())
    return true;
  std::array<char, 4> magic{};
  VSILFILE* file = VSIFOpenL(servedPath(path).c_str(), "rb");
  if (!file) return false;
  const bool whole = VSIFReadL(magic.data(), 1, magic.size(), file) == magic.size();
  VSIFCloseL(file);
  return whole && std::memcmp(magic.data(), "LASF", magic.size()) == 0;
}

/// What becomes of a text whose points fill a grid.
enum class GriddedText { isRaster, staysPoints };

/// True if GDAL reads the file as a raster, with what GDAL says meanwhile: some of its messages come once in
/// a process. Otherwise sets `opensAsVector`.
bool isRaster(const std::string& path, bool& opensAsVector, Warnings& said) {
  GdalErrors errors;
  GDALDriverH driver = GDALIdentifyDriverEx(servedPath(path).c_str(), GDAL_OF_RASTER, nullptr, nullptr);
  const bool identified = driver && !isTextDriver(driver);
  if (identified) {
    const GdalDatasetPtr dataset = openRasterForLength(path);
    if (dataset && (dataset->GetRasterCount() > 0 || dataset->GetMetadata("SUBDATASETS"))) {
      errors.moveTo(said);
      return true;
    }
  }
  opensAsVector = openGdal(path, GDAL_OF_VECTOR) != nullptr;
  return identified && !opensAsVector;
}

RasterReadOptions rasterOptions(const SourceReading& reading) {
  RasterReadOptions options;
  if (reading.band) options.band = static_cast<int>(*reading.band);
  options.crs = reading.crs;
  options.nodata = reading.nodata;
  options.verticalUnit = reading.verticalUnit;
  options.isDepth = reading.isDepth;
  return options;
}

Result<DemRead> readAsRaster(const std::string& path, const SourceReading& reading,
                             const RunContext& context) {
  if (!reading.layer.empty())
    return failure(ErrorCode::usage, fmt::format("is a raster, which has no layer '{}'", reading.layer),
                   path);
  if (!reading.zField.empty())
    return failure(ErrorCode::usage,
                   fmt::format("is a raster, which has bands and no field '{}'", reading.zField), path);
  if (!reading.samePlace.empty())
    return failure(ErrorCode::usage,
                   "is a raster, which has one height at a place; `samePlace` is for points", path);
  ARETE_TRY(auto read, readRaster(path, rasterOptions(reading), context));
  return DemRead{std::move(read.heightfield), std::move(read.warnings)};
}

Result<DemRead> readAsPoints(const std::string& path, bool mayBecomeRaster, const SourceReading& reading,
                             const RunContext& context) {
  if (reading.band)
    return failure(ErrorCode::usage, fmt::format("holds points, which have no band {}", *reading.band), path);
  PointReadOptions pointOptions;
  pointOptions.layer = reading.layer;
  pointOptions.zField = reading.zField;
  if (!reading.samePlace.empty()) {
    const auto rule = samePlaceNamed(reading.samePlace);
    if (!rule)
      return failure(ErrorCode::usage, "must be error, min, max, mean or first",
                     "samePlace " + reading.samePlace);
    pointOptions.samePlace = *rule;
  }
  pointOptions.crs = reading.crs;
  pointOptions.nodata = reading.nodata;
  pointOptions.verticalUnit = reading.verticalUnit;
  pointOptions.isDepth = reading.isDepth;
  NetworkReading network(context.cancel);
  ARETE_TRY(auto read, readPoints(path, pointOptions, context));
  if (Status same = network.finish(); !same) return failure(same.error().code, same.error().message, path);
  if (mayBecomeRaster) {
    if (auto raster = asRaster(read.heightfield)) {
      read.warnings.push_back(
          {WarningCode::choice,
           fmt::format("the points fill a grid of {} columns and {} rows: read as a raster", raster->columns,
                       raster->rows)});
      return DemRead{std::move(*raster), std::move(read.warnings)};
    }
  }
  return DemRead{std::move(read.heightfield), std::move(read.warnings)};
}

bool isTextOfNumbers(const std::string& path) {
  GdalErrors quiet;
  return isTextDriver(GDALIdentifyDriverEx(servedPath(path).c_str(), GDAL_OF_RASTER, nullptr, nullptr));
}

/// Reads the only raster in an archive, or its only text of points.
Result<DemRead> readZipped(const std::string& archive, const SourceReading& reading, GriddedText gridded,
                           const RunContext& context) {
  ARETE_TRY(const std::string inside, findZippedRaster(archive, context));
  if (isTextOfNumbers(inside))
    return readAsPoints(inside, gridded == GriddedText::isRaster, reading, context);
  return readAsRaster(archive, reading, context);
}

void addOnce(Warnings& warnings, const Warnings& more) {
  for (const Warning& warning : more)
    if (std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(warning);
}

std::string fileNameOf(const std::string& path) {
  return CPLGetFilename(nameWithoutQuery(path).c_str());
}

/// Reads several rasters as one.
Result<DemRead> readSeveral(const std::string& path, const std::vector<std::string>& files,
                            const SourceReading& reading, const RunContext& context) {
  for (const auto& [name, value] : {std::pair{"layer", &reading.layer}, std::pair{"zField", &reading.zField}})
    if (!value->empty())
      return failure(ErrorCode::usage, "is for points, and several files are read as one raster", name);
  Warnings said;
  for (const std::string& file : files) {
    if (isPlainZip(file)) continue;
    GdalErrors errors;
    bool opensAsVector = false;
    Warnings own;
    if (isRaster(file, opensAsVector, own)) {
      for (const Warning& warning : own) said.push_back(warning.behind(fileNameOf(file) + ": "));
      continue;
    }
    if (opensAsVector || looksLikePointText(file))
      return failure(ErrorCode::unsupported,
                     "holds points: several files are read as one only if all of them are rasters", file);
    openGdal(file, GDAL_OF_RASTER);
    return tl::unexpected(explainOpenFailure(file, "raster", errors));
  }
  ARETE_TRY(auto read, readRasters(files, rasterOptions(reading), context));
  read.heightfield.source = nameWithoutQuery(path);
  addOnce(read.warnings, said);
  return DemRead{std::move(read.heightfield), std::move(read.warnings)};
}

Result<DemRead> readFrom(const std::string& given, const SourceReading& reading, GriddedText gridded,
                         const RunContext& context) {
  registerGdal();
  std::string path = given;
  if (!reading.otherFiles.empty() || namesSeveralFiles(path)) {
    std::vector<std::string> names = {path};
    names.insert(names.end(), reading.otherFiles.begin(), reading.otherFiles.end());
    ARETE_TRY(const auto files, demFilesOf(names));
    if (files.size() > 1) return readSeveral(path, files, reading, context);
    path = files.front();
  }
  if (auto problem = findPipeProblem(path)) return tl::unexpected(*problem);
  if (isPointCloud(path))
    if (VSIStatBufL status; VSIStatL(servedPath(path).c_str(), &status) == 0)
      return failure(
          ErrorCode::unsupported,
          "is a point cloud, which Arete does not read; make a DEM or a text of its ground points first, for "
          "instance with PDAL: pdal translate IN.laz ground.csv -f filters.range "
          "--filters.range.limits='Classification[2:2]'",
          path);
  if (isPlainZip(path)) return readZipped(path, reading, gridded, context);
  bool opensAsVector = false;
  Warnings said;
  if (isRaster(path, opensAsVector, said)) {
    auto read = readAsRaster(path, reading, context);
    if (read) addOnce(read->warnings, said);
    return read;
  }
  if (context.cancelled()) return failure(ErrorCode::interrupted, "reading was stopped", path);

  GdalErrors errors;
  if (Status status = checkLengthByContent(path); !status)
    return failure(status.error().code, status.error().message, path);
  if (auto problem = findInputProblem(path)) return tl::unexpected(*problem);
  const bool text = looksLikePointText(path);
  if (text || opensAsVector)
    return readAsPoints(path, text && gridded == GriddedText::isRaster, reading, context);
  openGdal(path, GDAL_OF_RASTER | GDAL_OF_VECTOR);
  return tl::unexpected(explainOpenFailure(path, "DEM", errors));
}

/// The bounding box of a heightfield.
struct Extent {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  Vec2 low{kNone, kNone}, high{-kNone, -kNone};
  double lowest = kNone, highest = -kNone;

  void take(Vec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
};

Extent extentOf(const std::vector<double>& heights, Extent extent = {}) {
  for (const double z : heights) {
    extent.lowest = z < extent.lowest ? z : extent.lowest;  // false for NODATA
    extent.highest = z > extent.highest ? z : extent.highest;
  }
  return extent;
}

Extent extentOf(const RasterHeightfield& field) {
  Extent extent = extentOf(field.heights);
  for (const double column : {0.0, double(field.columns) - 1})
    for (const double row : {0.0, double(field.rows) - 1})
      extent.take(field.georeference.toSource(column, row));
  return extent;
}

Extent extentOf(const PointHeightfield& field) {
  Extent extent = extentOf(field.heights);
  for (const Vec2& p : field.positions) extent.take(p);
  return extent;
}

Vec2 middleOf(const Extent& e) {
  return {(e.low.x + e.high.x) / 2, (e.low.y + e.high.y) / 2};
}

/// A warning if the positions do not fit the CRS, or look like degrees without one. The numbers are the only
/// evidence.
template <class Heightfield>
std::optional<std::string> crsWarning(const Heightfield& field) {
  const Extent e = extentOf(field);
  if (field.georeference.isGeographic) {
    // Pixels beyond a pole are common, and so are longitudes beyond one turn.
    constexpr double kMostX = 12.6, kMostY = 1.6;  // radians
    const double x = std::max(std::abs(e.low.x), std::abs(e.high.x)),
                 y = std::max(std::abs(e.low.y), std::abs(e.high.y)),
                 unit = field.georeference.angularUnitRadians;
    if (!(x * unit > kMostX) && !(y * unit > kMostY)) return std::nullopt;
    return fmt::format(
        "its CRS has longitudes and latitudes, but its positions reach x {:g} and y {:g}, which are out of "
        "range: state the CRS that they are in",
        x, y);
  }
  // Longitudes and latitudes without a CRS: numbers in their range, and a range of heights far larger than
  // the width of the whole.
  const double width = std::max(e.high.x - e.low.x, e.high.y - e.low.y);
  const bool looksLikeDegrees = field.georeference.crsWkt.empty() && width > 0 && e.low.x >= -180 &&
                                e.high.x <= 360 && e.low.y >= -90 && e.high.y <= 90 &&
                                e.highest - e.lowest > 10 * width;
  if (!looksLikeDegrees) return std::nullopt;
  return "has no CRS, and its positions look like degrees: they are taken as lengths in the unit of the "
         "heights; state the CRS (EPSG:4326 for longitude and latitude)";
}

/// A warning of heights that stand alone. A reader of rasters warns itself of heights beyond 1e30.
template <class Heightfield>
std::optional<std::string> loneHeightsWarning(const Heightfield& field) {
  double scale = 1, offset = 0;
  if constexpr (std::is_same_v<Heightfield, RasterHeightfield>) {
    scale = field.rawScale;
    offset = field.rawOffset;
  }
  const LoneHeights lone = loneHeights(field.heights, scale, offset);
  constexpr double kHuge = 1e30;
  if (lone.count == 0 || std::max(-lone.lowest, lone.highest) > kHuge) return std::nullopt;
  return describe(lone, scale, offset);
}

Result<DemRead> readDemOf(const std::string& path, const SourceReading& reading, GriddedText gridded,
                          const RunContext& context) {
  NetworkReading network(context.cancel);
  // GDAL's driver of addresses fetches them by itself, and does not stop when told.
  const std::string opened = networkPathOf(path);
  Result<DemRead> read = readFrom(opened, reading, gridded, context);
  if (!read) {
    if (read.error().culprit == opened) read.error().culprit = path;
    // What a driver says of bytes that it did not get is a consequence.
    const auto cause = firstNetworkFailure();
    const bool isStopped = read.error().code == ErrorCode::interrupted;
    if (cause && !isStopped && read.error().message.find(cause->message) == std::string::npos)
      return failure(ErrorCode::unreadable, "cannot be read: " + cause->describe(), path);
    return read;
  }
  if (opened != path)
    std::visit([&](auto& field) { field.source = nameWithoutQuery(path); }, read->heightfield);
  if (auto* raster = std::get_if<RasterHeightfield>(&read->heightfield)) repeatFirstColumn(*raster);
  if (auto warning = std::visit([](const auto& field) { return crsWarning(field); }, read->heightfield))
    read->warnings.push_back({WarningCode::position, std::move(*warning)});
  if (auto warning =
          std::visit([](const auto& field) { return loneHeightsWarning(field); }, read->heightfield))
    read->warnings.push_back({WarningCode::heights, std::move(*warning)});
  std::visit([](auto& field) { stateMapScale(field.georeference, middleOf(extentOf(field))); },
             read->heightfield);
  return read;
}

}  // namespace

Result<DemRead> readDem(const std::string& path, const SourceReading& reading,
                        const RunContext& context) try {
  return readDemOf(path, reading, GriddedText::isRaster, context);
} catch (...) {
  return caughtFailure(path);
}

Result<DemRead> readDemAsItIs(const std::string& path, const SourceReading& reading,
                              const RunContext& context) try {
  return readDemOf(path, reading, GriddedText::staysPoints, context);
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
