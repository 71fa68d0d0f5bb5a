// SPDX-License-Identifier: GPL-3.0-or-later
//
// Opens the file, chooses the band, checks that it may hold heights, reads its georeference (geotransform,
// CRS, vertical unit and datum), reads the samples strip by strip and computes their checksum.
#include "io/dem/raster_reader.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/crs/reader.h"
#include "io/dem/band_heights.h"
#include "io/gdal/support.h"
#include "io/gdal/zipped_raster.h"

namespace arete {
namespace {

constexpr std::uint64_t kSampleLimit = (std::uint64_t(1) << 32) - 2;
constexpr int kSubdatasetsListed = 10;
constexpr double kGibibyte = 1024.0 * 1024.0 * 1024.0;

std::vector<std::string> subdatasetNames(GDALDataset& dataset) {
  std::vector<std::string> names;
  const CPLStringList metadata(dataset.GetMetadata("SUBDATASETS"), false);
  for (int i = 1;; ++i) {
    const char* name = metadata.FetchNameValue(fmt::format("SUBDATASET_{}_NAME", i).c_str());
    if (!name) return names;
    names.emplace_back(name);
  }
}

bool isColourImage(GDALDataset& dataset) {
  int colours = 0;
  for (int b = 1; b <= dataset.GetRasterCount(); ++b)
    if (dataset.GetRasterBand(b)->GetColorInterpretation() != GCI_AlphaBand) ++colours;
  GDALRasterBand& first = *dataset.GetRasterBand(1);
  return colours > 1 &&
         (first.GetRasterDataType() == GDT_Byte || first.GetColorInterpretation() == GCI_RedBand);
}

Result<GDALRasterBand*> chooseBand(GDALDataset& dataset, const RasterReadOptions& options,
                                   std::vector<std::string>& warnings) {
  const int count = dataset.GetRasterCount();
  const std::vector<std::string> parts = subdatasetNames(dataset);
  if (count == 0 && !parts.empty()) {
    const auto listed =
        parts.begin() + std::min<std::ptrdiff_t>(kSubdatasetsListed, std::ptrdiff_t(parts.size()));
    return failure(ErrorCode::unsupported,
                   fmt::format("holds {} rasters; name one of them: {}{}", parts.size(),
                               fmt::join(parts.begin(), listed, ", "), listed != parts.end() ? ", ..." : ""));
  }
  if (count == 0) return failure(ErrorCode::unsupported, "holds no raster band");
  const char* bands = count == 1 ? "band" : "bands";
  if (options.band && (*options.band < 1 || *options.band > count))
    return failure(ErrorCode::usage,
                   fmt::format("has {} {}; there is no band {}", count, bands, *options.band));
  if (!options.band && isColourImage(dataset))
    return failure(
        ErrorCode::unsupported,
        fmt::format("looks like a colour image of {} {}, not like heights; `band` reads one of its "
                    "bands as heights",
                    count, bands));
  if (!options.band && count > 1) warnings.push_back(fmt::format("has {} bands; band 1 is read", count));
  if (parts.size() > 1) warnings.push_back(fmt::format("holds {} rasters; the first is read", parts.size()));
  GDALRasterBand* band = dataset.GetRasterBand(options.band.value_or(1));
  if (band->GetColorTable())
    warnings.push_back("the band has a colour table: its values may be classes or colours, not heights");
  return band;
}

Status checkSize(GDALRasterBand& band) {
  const std::uint64_t columns = std::uint64_t(band.GetXSize()), rows = std::uint64_t(band.GetYSize());
  if (columns * rows >= kSampleLimit)
    return failure(ErrorCode::unsupported,
                   fmt::format("{} columns by {} rows are more than the {} samples that can be numbered",
                               columns, rows, kSampleLimit - 1));
  const double needed = double(columns * rows) * sizeof(double), usable = double(CPLGetUsablePhysicalRAM());
  if (usable > 0 && needed > usable)
    return failure(ErrorCode::unsupported,
                   fmt::format("{} columns by {} rows need {:.1f} GiB of memory; this machine has {:.1f} GiB",
                               columns, rows, needed / kGibibyte, usable / kGibibyte));
  return {};
}

void readGeoTransform(GDALDataset& dataset, Georeference& georeference, std::vector<std::string>& warnings) {
  std::array<double, 6> transform{};
  georeference.hasGeoTransform = dataset.GetGeoTransform(transform.data()) == CE_None;
  if (georeference.hasGeoTransform) {
    georeference.geoTransform = transform;
  } else if (dataset.GetGCPCount() > 0) {
    warnings.push_back("has only ground control points, which are not used: positions are columns and rows");
  } else if (dataset.GetMetadata("RPC")) {
    warnings.push_back("has only RPC coefficients, which are not used: positions are columns and rows");
  }
}

/// Call after describeCrs(). The unit of the band takes precedence over that of the CRS, the datum of the CRS
/// over that of the metadata.
void readVertical(GDALDataset& dataset, GDALRasterBand& band, Georeference& georeference,
                  std::vector<std::string>& warnings) {
  if (const std::string unit = band.GetUnitType() ? band.GetUnitType() : ""; !unit.empty()) {
    const bool crsSays = !georeference.verticalUnit.empty();
    const auto metres = metresPerUnit(unit);
    if (!metres) {
      warnings.push_back(fmt::format(
          "the unit of height '{}' is not known; {}", unit,
          crsSays ? "that of the CRS is used" : "heights are taken as metres where metres are needed"));
      if (crsSays) return;
    } else if (crsSays && std::abs(*metres - georeference.verticalUnitMetres) > 1e-9) {
      warnings.push_back(fmt::format("the band's unit of height is '{}', the CRS's '{}'; the band's is used",
                                     unit, georeference.verticalUnit));
    }
    georeference.verticalUnit = unit;
    georeference.verticalUnitMetres = metres.value_or(1);
  }
  if (const char* datum = dataset.GetMetadataItem("DTED_VerticalDatum");
      datum && georeference.verticalDatum.empty()) {
    georeference.verticalDatum = EQUAL(datum, "E96") ? "EGM96" : datum;
  }
}

Result<RasterRead> readOpened(GDALDataset& dataset, const std::string& path, const RasterReadOptions& options,
                              GdalErrors& errors, const RunContext& context) {
  RasterRead read;
  auto band = chooseBand(dataset, options, read.warnings);
  if (!band) return tl::unexpected(band.error());
  if (Status status = checkSize(**band); !status) return tl::unexpected(status.error());

  RasterHeightfield& heightfield = read.heightfield;
  Georeference& georeference = heightfield.georeference;
  readGeoTransform(dataset, georeference, read.warnings);
  auto crs = chooseCrs(dataset.GetSpatialRef(), options.crs, read.warnings);
  if (!crs) return tl::unexpected(crs.error());
  if (Status status = describeCrs(*crs, georeference); !status) return tl::unexpected(status.error());
  readVertical(dataset, **band, georeference, read.warnings);

  auto samples = readBandHeights(**band, options.nodata, read.warnings, context);
  if (!samples) return tl::unexpected(samples.error());
  errors.moveTo(read.warnings);
  heightfield.columns = std::uint32_t((*band)->GetXSize());
  heightfield.rows = std::uint32_t((*band)->GetYSize());
  heightfield.heights = std::move(samples->heights);
  heightfield.rawScale = samples->scale;
  heightfield.rawOffset = samples->offset;
  heightfield.source = path;
  heightfield.sourceChecksum = heightsChecksum(heightfield);
  if (Status status = heightfield.validate(); !status) return tl::unexpected(status.error());
  return read;
}

}  // namespace

Result<RasterRead> readRaster(const std::string& path, const RasterReadOptions& options,
                              const RunContext& context) try {
  registerGdal();
  GdalErrors errors;
  const Result<std::string> gdalPath = rasterPathOf(path);
  if (!gdalPath) return tl::unexpected(gdalPath.error());
  const GdalDatasetPtr dataset = openGdal(*gdalPath, GDAL_OF_RASTER);
  if (!dataset) return tl::unexpected(explainOpenFailure(*gdalPath, "raster", errors));
  auto read = readOpened(*dataset, path, options, errors, context);
  if (!read && read.error().culprit.empty()) read.error().culprit = path;
  return read;
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
