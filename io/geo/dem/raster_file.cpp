// SPDX-License-Identifier: GPL-3.0-or-later
//
// Opens the file, chooses the band, checks that it may hold heights and that the file is as long as its
// header states, and reads its georeference (position, CRS, vertical unit, datum and direction).
#include "io/geo/dem/raster_file.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "io/geo/crs/reader.h"
#include "io/geo/crs/vertical.h"
#include "io/geo/dem/band_reader.h"
#include "io/geo/dem/declared_length.h"
#include "io/geo/dem/raster_placement.h"
#include "io/geo/gdal/file_length.h"
#include "io/geo/gdal/support.h"
#include "io/geo/gdal/zipped_raster.h"
#include "io/geo/network/network_path.h"

namespace arete {
namespace {

constexpr int kSubdatasetsListed = 10;

std::vector<std::string> subdatasetNames(GDALDataset& dataset) {
  std::vector<std::string> names;
  const CPLStringList metadata(dataset.GetMetadata("SUBDATASETS"), false);
  for (int i = 1;; ++i) {
    const char* name = metadata.FetchNameValue(fmt::format("SUBDATASET_{}_NAME", i).c_str());
    if (!name) return names;
    names.push_back(withoutServing(name));
  }
}

int countOfBandsBesideOpacity(GDALDataset& dataset) {
  int count = 0;
  for (int b = 1; b <= dataset.GetRasterCount(); ++b)
    if (dataset.GetRasterBand(b)->GetColorInterpretation() != GCI_AlphaBand) ++count;
  return count;
}

bool isColourImage(GDALDataset& dataset) {
  GDALRasterBand& first = *dataset.GetRasterBand(1);
  return countOfBandsBesideOpacity(dataset) > 1 &&
         (first.GetRasterDataType() == GDT_Byte || first.GetColorInterpretation() == GCI_RedBand);
}

Result<GDALRasterBand*> chooseBand(GDALDataset& dataset, const RasterReadOptions& options,
                                   Warnings& warnings) {
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
  if (!options.band && countOfBandsBesideOpacity(dataset) > 1)
    warnings.push_back({WarningCode::choice, fmt::format("has {} bands; band 1 is read", count)});
  if (parts.size() > 1)
    warnings.push_back(
        {WarningCode::choice, fmt::format("holds {} rasters; the first is read", parts.size())});
  GDALRasterBand* band = dataset.GetRasterBand(options.band.value_or(1));
  if (band->GetColorTable())
    warnings.push_back({WarningCode::heights,
                        "the band has a colour table: its values may be classes or colours, not heights"});
  return band;
}

std::string itemOf(GDALMajorObject& object, const char* name) {
  const char* value = object.GetMetadataItem(name);
  return value ? value : "";
}

VerticalSigns verticalSignsOf(GDALDataset& dataset, GDALRasterBand& band) {
  VerticalSigns signs;
  signs.unit = band.GetUnitType() ? band.GetUnitType() : "";
  const std::string datum = itemOf(dataset, "DTED_VerticalDatum");
  signs.datum = EQUAL(datum.c_str(), "E96") ? "EGM96" : datum;
  const char* driver = dataset.GetDriver() ? dataset.GetDriver()->GetDescription() : "";
  // An elevation of a BAG counts upwards by its specification; depths of S-102 count downwards by theirs.
  signs.isUp = EQUAL(driver, "BAG");
  if (EQUAL(driver, "S102")) signs.depthName = "it is a file of depths (S-102)";
  const std::string positive = itemOf(band, "positive"), standardName = itemOf(band, "standard_name");
  if (EQUAL(positive.c_str(), "down"))
    signs.depthName = "its variable counts downwards (positive: down)";
  else if (positive.empty() && (standardName == "depth" || standardName.starts_with("depth_below_") ||
                                standardName.starts_with("sea_floor_depth_below_")))
    signs.depthName = fmt::format("its variable is a depth ({})", standardName);
  return signs;
}

}  // namespace

struct RasterFile::Opened {
  GdalDatasetPtr dataset;
  std::optional<BandReader> reader;
  Georeference georeference;
  std::uint32_t columns = 0, rows = 0;

  ~Opened() {
    const GdalErrors quiet;
    dataset.reset();
  }
};

RasterFile::RasterFile(std::unique_ptr<Opened> opened) : opened_(std::move(opened)) {}
RasterFile::RasterFile(RasterFile&&) noexcept = default;
RasterFile& RasterFile::operator=(RasterFile&&) noexcept = default;
RasterFile::~RasterFile() = default;

Result<RasterFile> RasterFile::open(const std::string& path, const RasterReadOptions& options,
                                    Warnings& warnings, const RunContext& context) {
  registerGdal();
  GdalErrors errors;
  const auto blame = [&](Error error) {
    if (error.culprit.empty()) error.culprit = path;
    return tl::unexpected(std::move(error));
  };
  const Result<std::string> gdalPath = rasterPathOf(networkPathOf(path), context);
  if (!gdalPath) return blame(gdalPath.error());
  if (Status status = checkLengthByContent(*gdalPath); !status) return blame(status.error());

  warnOfLength(*gdalPath, warnings);

  auto opened = std::make_unique<Opened>();
  opened->dataset = openRasterForLength(*gdalPath);
  if (!opened->dataset) return tl::unexpected(explainOpenFailure(*gdalPath, "raster", errors));
  GDALDataset& dataset = *opened->dataset;
  const auto band = chooseBand(dataset, options, warnings);
  if (!band) return blame(band.error());
  if (Status status = checkDeclaredLength(dataset); !status) return blame(status.error());

  const auto own = placeRaster(dataset, opened->georeference, warnings);
  if (!own) return blame(own.error());
  const auto crs = chooseCrs(own->IsEmpty() ? nullptr : &*own, options.crs, warnings);
  if (!crs) return blame(crs.error());
  const auto isDepth =
      describeVertical(*crs, verticalSignsOf(dataset, **band), {options.verticalUnit, options.isDepth},
                       opened->georeference, warnings);
  if (!isDepth) return blame(isDepth.error());
  auto reader = BandReader::of(**band, options.nodata, *isDepth);
  if (!reader) return blame(reader.error());
  opened->reader = std::move(*reader);
  opened->columns = std::uint32_t((*band)->GetXSize());
  opened->rows = std::uint32_t((*band)->GetYSize());
  if (const std::string said = errors.firstFileFailure(); !said.empty())
    return blame({ErrorCode::corrupt, fmt::format("is cut short or damaged: {}", said), {}});
  errors.moveTo(warnings);
  return RasterFile(std::move(opened));
}

std::uint32_t RasterFile::columns() const {
  return opened_->columns;
}
std::uint32_t RasterFile::rows() const {
  return opened_->rows;
}
const Georeference& RasterFile::georeference() const {
  return opened_->georeference;
}
double RasterFile::rawScale() const {
  return opened_->reader->scale();
}
double RasterFile::rawOffset() const {
  return opened_->reader->offset();
}
std::uint32_t RasterFile::stripRows() const {
  return std::uint32_t(opened_->reader->stripRows());
}

Status RasterFile::read(std::uint32_t firstRow, std::uint32_t rowCount, std::span<double> heights) {
  return opened_->reader->read(int(firstRow), int(rowCount), heights);
}

void RasterFile::report(Warnings& warnings) const {
  opened_->reader->report(warnings);
}

}  // namespace arete
