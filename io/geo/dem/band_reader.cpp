// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rows are read directly into the heights and decoded there: NODATA on the raw value first, then masks and
// absent blocks, then scale and offset. Samples of 64-bit integers go through a separate strip, since a
// double holds them only up to 2^53.
//
// GDAL gives the mask of a band by the first of several sources (a mask file, NODATA, opacity), and opacity
// only for two or four bands of 8 or 16 bits without a sign. Here all of them count: a sample is valid if it
// is not NODATA, not masked and not fully transparent.
//
// A message of GDAL during a read is an error, whatever GDAL returns: some drivers fill what they cannot read
// and warn.
#include "io/geo/dem/band_reader.h"

#include <cpl_string.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "engine/base/counted.h"
#include "io/geo/gdal/support.h"

namespace arete {
namespace {

constexpr std::size_t kStripSamples = std::size_t(1) << 20;
constexpr std::size_t kLargestStripSamples = std::size_t(1) << 24;
constexpr double kHugeHeight = 1e30;
constexpr double kHugeTolerance = 1e-5;
constexpr std::int64_t kLargestExactInteger = std::int64_t(1) << 53;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

int stripRowsOf(GDALRasterBand& band) {
  int blockColumns = 0, blockRows = 0;
  band.GetBlockSize(&blockColumns, &blockRows);
  const std::size_t columns = std::size_t(band.GetXSize());
  std::size_t rows = std::max<std::size_t>(1, kStripSamples / columns);
  const std::size_t block = std::size_t(std::max(1, blockRows));
  if (block * columns <= kLargestStripSamples) rows = (rows + block - 1) / block * block;
  return int(std::min(rows, std::size_t(band.GetYSize())));
}

/// @return Whether the driver knows which blocks are absent, and some are.
/// @param said Receives the messages of GDAL, which reports each once.
bool hasAbsentBlocks(GDALRasterBand& band, std::string& said) {
  const GdalErrors errors;
  const int status = band.GetDataCoverageStatus(0, 0, band.GetXSize(), band.GetYSize(), 0, nullptr);
  said = errors.firstMessage();
  return (status & GDAL_DATA_COVERAGE_STATUS_UNIMPLEMENTED) == 0 &&
         (status & GDAL_DATA_COVERAGE_STATUS_EMPTY) != 0;
}

/// The middle of a range, on a border of blocks where there is one within.
int splitOf(int first, int count, int block) {
  const int middle = first + count / 2, onBlock = middle / block * block;
  if (onBlock > first) return onBlock;
  return onBlock + block < first + count ? onBlock + block : middle;
}

}  // namespace

// A value of a 32-bit band is compared as a float, since files declare it in decimal digits. Huge values,
// such as -3.4e38, are written with varying digits, so they have a relative tolerance.
BandReader::NodataTest::NodataTest(std::optional<double> value, GDALDataType type)
    : stated_(value && !std::isnan(*value)) {
  if (!stated_) return;
  value_ = *value;
  if (type == GDT_Float32 && std::abs(value_) <= double(std::numeric_limits<float>::max()))
    value_ = double(float(value_));
  const bool isHuge = std::abs(value_) > kHugeHeight && std::isfinite(value_);
  tolerance_ = isHuge ? kHugeTolerance * std::abs(value_) : 0;
}

GDALRasterBand* alphaBandOf(GDALRasterBand& band) {
  GDALDataset* dataset = band.GetDataset();
  if (!dataset) return nullptr;
  for (int b = 1; b <= dataset->GetRasterCount(); ++b) {
    GDALRasterBand* other = dataset->GetRasterBand(b);
    if (other && other->GetColorInterpretation() == GCI_AlphaBand) return other == &band ? nullptr : other;
  }
  return nullptr;
}

// The declared NODATA value of 64-bit integers is kept as such, since a double would round it. The mask that
// GDAL derives from NODATA or opacity is passed over: both are tested here.
BandReader::BandReader(GDALRasterBand& band, std::optional<double> nodata)
    : band_(&band), type_(band.GetRasterDataType()), stripRows_(stripRowsOf(band)) {
  const char* pixelType = band.GetMetadataItem("PIXELTYPE", "IMAGE_STRUCTURE");
  signedByte_ = type_ == GDT_Byte && pixelType && EQUAL(pixelType, "SIGNEDBYTE");
  int declared = 0;
  if (nodata) {
    nodata_ = NodataTest(nodata, type_);
  } else if (type_ == GDT_Int64) {
    signedNodata_ = band.GetNoDataValueAsInt64(&declared);
    hasWideNodata_ = declared != 0;
  } else if (type_ == GDT_UInt64) {
    unsignedNodata_ = band.GetNoDataValueAsUInt64(&declared);
    hasWideNodata_ = declared != 0;
  } else {
    const double value = band.GetNoDataValue(&declared);
    if (declared) nodata_ = NodataTest(value, type_);
  }
  const int flags = band.GetMaskFlags();
  if ((flags & (GMF_ALL_VALID | GMF_ALPHA)) == 0 && flags != GMF_NODATA) masks_.push_back(band.GetMaskBand());
  if (GDALRasterBand* alpha = alphaBandOf(band)) masks_.push_back(alpha);
  mayBeSparse_ = hasAbsentBlocks(band, saidBefore_);
}

Result<BandReader> BandReader::of(GDALRasterBand& band, std::optional<double> nodata, bool isDepth) {
  if (GDALDataTypeIsComplex(band.GetRasterDataType()))
    return failure(ErrorCode::unsupported,
                   fmt::format("band {} holds complex numbers ({}), not heights", band.GetBand(),
                               GDALGetDataTypeName(band.GetRasterDataType())));
  const double scale = band.GetScale(), offset = band.GetOffset();
  if (scale == 0 || !std::isfinite(scale) || !std::isfinite(offset))
    return failure(ErrorCode::invalidData, fmt::format("band {} declares the scale {} and the offset {}",
                                                       band.GetBand(), scale, offset));
  BandReader reader(band, nodata);
  reader.scale_ = isDepth ? -scale : scale;
  reader.offset_ = isDepth && offset != 0 ? -offset : offset;
  return reader;
}

/// This fails with the message of GDAL. GDAL reports each message once, so one from the constructor stands in
/// where it gives no reason now.
Status BandReader::transfer(GDALRasterBand& band, int firstRow, int rowCount, void* buffer,
                            GDALDataType type) {
  GdalErrors errors;
  const int columns = band.GetXSize();
  const CPLErr status =
      band.RasterIO(GF_Read, 0, firstRow, columns, rowCount, buffer, columns, rowCount, type, 0, 0, nullptr);
  std::string said = errors.firstFailure();
  if (said.empty()) said = errors.firstMessage();
  if (status == CE_None && said.empty()) return {};
  return failure(ErrorCode::unreadable,
                 fmt::format("rows {} to {} cannot be read: {}", firstRow, firstRow + rowCount - 1,
                             !said.empty()          ? said
                             : !saidBefore_.empty() ? saidBefore_
                                                    : "GDAL gives no reason"));
}

Status BandReader::readPlain(int firstRow, int rowCount, std::span<double> raw) {
  ARETE_CHECK(transfer(*band_, firstRow, rowCount, raw.data(), GDT_Float64));
  for (double& value : raw) {
    if (signedByte_ && value > 127) value -= 256;
    if (nodata_(value)) value = kNan;
  }
  return {};
}

/// Reads 64-bit integers: NODATA is compared before the conversion, and a height that a double cannot hold is
/// an error and not rounded silently.
template <class Integer>
Status BandReader::readWide(int firstRow, int rowCount, std::span<double> raw) {
  std::vector<Integer> strip(raw.size());
  ARETE_CHECK(transfer(*band_, firstRow, rowCount, strip.data(), type_));
  const auto isNodata = [&](Integer value) {
    if (!hasWideNodata_) return nodata_(double(value));
    if constexpr (std::is_signed_v<Integer>) return value == signedNodata_;
    return value == Integer(unsignedNodata_);
  };
  for (std::size_t i = 0; i < strip.size(); ++i) {
    const Integer value = strip[i];
    if (isNodata(value)) {
      raw[i] = kNan;
      continue;
    }
    bool exact = value <= Integer(kLargestExactInteger);
    if constexpr (std::is_signed_v<Integer>) exact = exact && value >= -kLargestExactInteger;
    if (!exact) {
      const std::size_t columns = std::size_t(band_->GetXSize());
      return failure(
          ErrorCode::invalidData,
          fmt::format("the 64-bit height {} at column {}, row {} is beyond 2^53, so a double cannot hold it",
                      value, i % columns, std::size_t(firstRow) + i / columns));
    }
    raw[i] = double(value);
  }
  return {};
}

Status BandReader::applyMask(GDALRasterBand& mask, int firstRow, int rowCount, std::span<double> raw) {
  maskStrip_.resize(raw.size());
  ARETE_CHECK(transfer(mask, firstRow, rowCount, maskStrip_.data(), GDT_Float64));
  for (std::size_t i = 0; i < raw.size(); ++i)
    if (!(maskStrip_[i] > 0)) raw[i] = kNan;
  return {};
}

// A window that is partly absent is halved, at borders of blocks, until each part is present or absent.
void BandReader::takeAbsentOut(int column, int row, int columns, int rows, int firstRow,
                               std::span<double> raw) {
  const int status = band_->GetDataCoverageStatus(column, row, columns, rows, 0, nullptr);
  if ((status & GDAL_DATA_COVERAGE_STATUS_EMPTY) == 0) return;
  const bool isMixed = (status & GDAL_DATA_COVERAGE_STATUS_DATA) != 0;
  if (isMixed && columns * std::int64_t(rows) > 1) {
    int blockColumns = 1, blockRows = 1;
    band_->GetBlockSize(&blockColumns, &blockRows);
    const bool isAcross = columns > 1 && (columns >= rows || rows == 1);
    if (isAcross) {
      const int split = splitOf(column, columns, std::max(1, blockColumns));
      takeAbsentOut(column, row, split - column, rows, firstRow, raw);
      takeAbsentOut(split, row, column + columns - split, rows, firstRow, raw);
    } else {
      const int split = splitOf(row, rows, std::max(1, blockRows));
      takeAbsentOut(column, row, columns, split - row, firstRow, raw);
      takeAbsentOut(column, split, columns, row + rows - split, firstRow, raw);
    }
    return;
  }
  if (isMixed) return;
  const std::size_t width = std::size_t(band_->GetXSize());
  for (int r = row; r < row + rows; ++r) {
    const auto begin = raw.begin() + std::ptrdiff_t(std::size_t(r - firstRow) * width + std::size_t(column));
    std::fill(begin, begin + columns, kNan);
  }
  absent_ += std::size_t(columns) * std::size_t(rows);
}

// Absent blocks are looked for only if the file has some. The constructor has kept what GDAL says about them,
// so its messages are dropped here.
Status BandReader::read(int firstRow, int rowCount, std::span<double> heights) {
  Status status = type_ == GDT_Int64    ? readWide<std::int64_t>(firstRow, rowCount, heights)
                  : type_ == GDT_UInt64 ? readWide<std::uint64_t>(firstRow, rowCount, heights)
                                        : readPlain(firstRow, rowCount, heights);
  for (GDALRasterBand* mask : masks_)
    if (status) status = applyMask(*mask, firstRow, rowCount, heights);
  if (!status) return status;
  if (mayBeSparse_) {
    const GdalErrors quiet;
    takeAbsentOut(0, firstRow, band_->GetXSize(), rowCount, firstRow, heights);
  }
  for (double& height : heights) {
    height = height * scale_ + offset_;
    if (std::isinf(height)) {
      ++infinite_;
      height = kNan;
    } else if (std::abs(height) > kHugeHeight) {
      ++huge_;
      hugeExample_ = height;
    }
  }
  return {};
}

void BandReader::report(Warnings& warnings) const {
  if (!saidBefore_.empty()) warnings.push_back({WarningCode::library, "GDAL: " + saidBefore_});
  if (absent_ > 0)
    warnings.push_back({WarningCode::heights,
                        counted(absent_, "sample lies in a block that the file leaves out: it is NODATA",
                                "samples lie in blocks that the file leaves out: they are NODATA")});
  if (infinite_ > 0)
    warnings.push_back({WarningCode::heights, counted(infinite_, "infinite height is taken as NODATA",
                                                      "infinite heights are taken as NODATA")});
  if (huge_ > 0)
    warnings.push_back({WarningCode::heights,
                        fmt::format("{} as large as {}: an undeclared NODATA value? `nodata` states it",
                                    counted(huge_, "height is", "heights are"), hugeExample_)});
}

}  // namespace arete
