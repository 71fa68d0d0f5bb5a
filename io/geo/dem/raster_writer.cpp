// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rows of whole tiles go to GDAL, which compresses them with the floating-point predictor. The file grows
// under a temporary name beside the final one. GDAL reports failures on closing only through its error
// handler, so the file is renamed after it is closed and if the handler has collected no failure.
#include "io/geo/dem/raster_writer.h"

#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string_view>
#include <vector>

#include "engine/base/caught_failure.h"
#include "io/files/output_file.h"
#include "io/files/text_scan.h"
#include "io/geo/crs/reader.h"
#include "io/geo/gdal/support.h"

namespace arete {
namespace {

constexpr int kTileSize = 256;

bool isWhole(GeoTiffOptions::Sample sample) {
  return sample == GeoTiffOptions::Sample::uint8 || sample == GeoTiffOptions::Sample::uint16;
}

CPLStringList creationOptions(GDALDriver& driver, const GeoTiffOptions& options) {
  CPLStringList list;
  list.SetNameValue("TILED", "YES");
  list.SetNameValue("BLOCKXSIZE", std::to_string(kTileSize).c_str());
  list.SetNameValue("BLOCKYSIZE", std::to_string(kTileSize).c_str());
  list.SetNameValue("BIGTIFF", "IF_SAFER");
  if (options.compression == GeoTiffOptions::Compression::none) return list;
  const char* known = driver.GetMetadataItem(GDAL_DMD_CREATIONOPTIONLIST);
  // Not every build of GDAL has ZSTD; DEFLATE is always there.
  const bool zstd =
      options.compression == GeoTiffOptions::Compression::zstd && known && std::strstr(known, "ZSTD");
  list.SetNameValue("COMPRESS", zstd ? "ZSTD" : "DEFLATE");
  list.SetNameValue("PREDICTOR", isWhole(options.sample) ? "1" : "3");
  return list;
}

Status describe(GDALDataset& dataset, const Georeference& georeference, const GeoTiffOptions& options) {
  if (!georeference.crsWkt.empty()) {
    ARETE_TRY(auto crs, crsFromText(georeference.crsWkt));
    if (dataset.SetSpatialRef(&crs) != CE_None)
      return failure(ErrorCode::unreadable, "the CRS cannot be written");
  }
  if (georeference.hasGeoTransform) {
    std::array<double, 6> transform = georeference.geoTransform;
    if (dataset.SetGeoTransform(transform.data()) != CE_None)
      return failure(ErrorCode::unreadable, "the geotransform cannot be written");
  }
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  if (!options.colors.empty() && options.sample == GeoTiffOptions::Sample::uint8) {
    GDALColorTable table;
    for (const GeoTiffOptions::Color& color : options.colors) {
      const GDALColorEntry entry{color.red, color.green, color.blue, 255};
      table.SetColorEntry(color.value, &entry);
    }
    if (band.SetColorTable(&table) != CE_None)
      return failure(ErrorCode::unreadable, "the colour table cannot be written");
  }
  // Whole numbers need a value of their own for NODATA, floats have NaN.
  band.SetNoDataValue(isWhole(options.sample) ? options.nodata : std::numeric_limits<double>::quiet_NaN());
  if (!georeference.verticalUnit.empty()) band.SetUnitType(georeference.verticalUnit.c_str());
  if (!options.description.empty()) band.SetDescription(options.description.c_str());
  return {};
}

template <class Sample>
std::size_t hashOf(std::span<const Sample> samples) {
  const auto bytes = std::as_bytes(samples);
  return std::hash<std::string_view>()({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// Reads a raster that was closed, and compares it with what was written, by the hash of each strip.
template <class Sample>
Status readBack(const std::string& path, GDALDataType type, std::span<const std::size_t> hashes,
                const GdalErrors& errors, const RunContext& context) {
  const auto unlike = [&] {
    return failure(ErrorCode::unreadable,
                   errors.anyFailure()
                       ? fmt::format("cannot be read after it was written: {}", errors.firstFailure())
                       : "does not hold the values that were written to it");
  };
  // The file is opened anew, so that what is compared comes from the file and not from a cache.
  const GdalDatasetPtr dataset(
      GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR, nullptr, nullptr, nullptr));
  if (!dataset || dataset->GetRasterCount() != 1) return unlike();
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  const int columns = band.GetXSize(), rows = band.GetYSize();
  std::vector<Sample> strip;
  std::size_t at = 0;
  for (int row = 0; row < rows; row += kTileSize, ++at) {
    if (context.cancelled()) return failure(ErrorCode::interrupted, "writing was stopped");
    const int count = std::min(kTileSize, rows - row);
    strip.resize(std::size_t(count) * std::size_t(columns));
    if (band.RasterIO(GF_Read, 0, row, columns, count, strip.data(), columns, count, type, 0, 0, nullptr) !=
            CE_None ||
        at >= hashes.size() || hashOf(std::span<const Sample>(strip)) != hashes[at])
      return unlike();
  }
  return at == hashes.size() ? Status() : unlike();
}

template <class Sample>
Status writeRows(GDALRasterBand& band, std::span<const double> values, std::size_t stride, GDALDataType type,
                 double nodata, std::vector<std::size_t>& hashes, const GdalErrors& errors,
                 const RunContext& context) {
  const std::size_t columns = std::size_t(band.GetXSize());
  const int rows = band.GetYSize();
  std::vector<Sample> strip;
  for (int row = 0; row < rows; row += kTileSize) {
    if (context.cancelled()) return failure(ErrorCode::interrupted, "writing was stopped");
    context.report("writing", double(row) / rows);
    const int count = std::min(kTileSize, rows - row);
    strip.clear();
    for (std::size_t i = 0; i < std::size_t(count) * columns; ++i) {
      const double value = values[(std::size_t(row) + i / columns) * stride + i % columns];
      using Limits = std::numeric_limits<Sample>;
      if constexpr (Limits::is_integer) {
        // A whole number cannot be NaN, so the raster's NODATA value takes its place.
        const double whole = std::isnan(value) ? nodata : value;
        if (!(whole >= 0 && whole <= double(Limits::max())))
          return failure(ErrorCode::invalidData,
                         fmt::format("the value {} does not fit {} bits", whole, Limits::digits));
        strip.push_back(Sample(whole));
      } else {
        if (std::isfinite(value) && std::abs(value) > double(Limits::max()))
          return failure(ErrorCode::invalidData,
                         fmt::format("the value {} does not fit a 32-bit float", value));
        strip.push_back(Sample(value));
      }
    }
    hashes.push_back(hashOf(std::span<const Sample>(strip)));
    if (band.RasterIO(GF_Write, 0, row, int(columns), count, strip.data(), int(columns), count, type, 0, 0,
                      nullptr) != CE_None)
      return failure(ErrorCode::unreadable, fmt::format("cannot be written: {}", errors.firstFailure()));
  }
  return {};
}

Status writeTo(const std::string& path, std::uint32_t columns, std::uint32_t rows,
               std::span<const double> values, const Georeference& georeference,
               const GeoTiffOptions& options, const RunContext& context) {
  GdalErrors errors;
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  if (!driver) return failure(ErrorCode::unsupported, "this GDAL cannot write GeoTIFF");
  using Sample = GeoTiffOptions::Sample;
  const GDALDataType type = options.sample == Sample::float64   ? GDT_Float64
                            : options.sample == Sample::float32 ? GDT_Float32
                            : options.sample == Sample::uint8   ? GDT_Byte
                                                                : GDT_UInt16;
  const CPLStringList list = creationOptions(*driver, options);
  // A DEM around the globe repeats its first column at the end; the file does not.
  const std::uint32_t written = georeference.repeatsFirstColumn && columns > 1 ? columns - 1 : columns;
  GdalDatasetPtr dataset(driver->Create(path.c_str(), int(written), int(rows), 1, type, list.List()));
  if (!dataset)
    return failure(ErrorCode::unreadable, fmt::format("cannot be created: {}", errors.firstFailure()));
  ARETE_CHECK(describe(*dataset, georeference, options));
  errors.clear();

  GDALRasterBand& band = *dataset->GetRasterBand(1);
  std::vector<std::size_t> hashes;
  const auto write = [&](auto sample) -> Status {
    using Type = decltype(sample);
    if (Status rowsWritten =
            writeRows<Type>(band, values, columns, type, options.nodata, hashes, errors, context);
        !rowsWritten)
      return rowsWritten;
    // Closing writes what is left; a failure there reaches only the error handler.
    dataset.reset();
    if (errors.anyFailure())
      return failure(ErrorCode::unreadable, fmt::format("cannot be written: {}", errors.firstFailure()));
    return readBack<Type>(path, type, hashes, errors, context);
  };
  return options.sample == Sample::float64   ? write(double{})
         : options.sample == Sample::float32 ? write(float{})
         : options.sample == Sample::uint8   ? write(std::uint8_t{})
                                             : write(std::uint16_t{});
}

}  // namespace

bool isGeoTiffName(const std::string& path) {
  const std::string extension = text::lowerExtension(path);
  return extension == "tif" || extension == "tiff";
}

Status writeGeoTiff(const std::string& path, std::uint32_t columns, std::uint32_t rows,
                    std::span<const double> values, const Georeference& georeference,
                    const GeoTiffOptions& options, const RunContext& context) try {
  constexpr std::uint32_t kLargestSide = std::uint32_t(std::numeric_limits<int>::max());
  if (columns == 0 || rows == 0 || columns > kLargestSide || rows > kLargestSide ||
      values.size() != std::size_t(columns) * rows)
    return failure(ErrorCode::invalidData,
                   fmt::format("{} values for {} columns and {} rows", values.size(), columns, rows), path);
  registerGdal();
  ARETE_TRY(auto file, OutputFile::create(path));
  // Overviews and masks of an older file do not describe this one.
  file.removeBeside({".ovr", ".msk"});
  Status status =
      writeTo(file.temporaryPath().string(), columns, rows, values, georeference, options, context);
  if (status) status = file.commit();
  if (!status && status.error().culprit.empty()) status.error().culprit = path;
  if (status) context.report("writing", 1);
  return status;
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
