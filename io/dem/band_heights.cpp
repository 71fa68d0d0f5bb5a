// SPDX-License-Identifier: GPL-3.0-or-later
//
// Strips of whole rows, of about a million samples and whole blocks of the file, are read directly into the
// array of heights and decoded there: NODATA on the raw value first, then scale and offset. Samples of 64-bit
// integers go through a separate strip, since a double holds them only up to 2^53.
//
// The memory is reserved at once but touched strip by strip, so that a file that states more samples than it
// has fails early.
#include "io/dem/band_heights.h"

#include <cpl_string.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "engine/memory/pages.h"
#include "io/gdal/support.h"

namespace arete {
namespace {

constexpr std::size_t kStripSamples = std::size_t(1) << 20;
constexpr std::size_t kLargestStripSamples = std::size_t(1) << 24;
constexpr double kHugeHeight = 1e30;
constexpr double kHugeTolerance = 1e-5;
constexpr std::int64_t kLargestExactInteger = std::int64_t(1) << 53;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class NodataTest {
 public:
  NodataTest(std::optional<double> value, GDALDataType type) : stated_(value && !std::isnan(*value)) {
    if (!stated_) return;
    value_ = *value;
    asFloat_ = type == GDT_Float32 && std::abs(value_) <= double(std::numeric_limits<float>::max());
    if (asFloat_) value_ = double(float(value_));
    const bool isHuge = std::abs(value_) > kHugeHeight && std::isfinite(value_);
    tolerance_ = isHuge ? kHugeTolerance * std::abs(value_) : 0;
  }

  bool operator()(double raw) const {
    return stated_ && (raw == value_ || (tolerance_ > 0 && std::abs(raw - value_) <= tolerance_));
  }

 private:
  bool stated_ = false;
  bool asFloat_ = false;
  double value_ = 0;
  double tolerance_ = 0;
};

/// Reads the strips of one band, raw values as doubles.
class StripReader {
 public:
  StripReader(GDALRasterBand& band, std::optional<double> nodata)
      : band_(band), type_(band.GetRasterDataType()) {
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
    const bool fromNodataOnly = flags == GMF_NODATA;
    if (!(flags & GMF_ALL_VALID) && !fromNodataOnly) mask_ = band.GetMaskBand();
  }

  /// Raw values, NaN for NODATA. Errors: unreadable: from GDAL. invalidData: a 64-bit height beyond 2^53.
  Status read(int firstRow, int rowCount, std::span<double> raw) {
    Status status = type_ == GDT_Int64    ? readWide<std::int64_t>(firstRow, rowCount, raw)
                    : type_ == GDT_UInt64 ? readWide<std::uint64_t>(firstRow, rowCount, raw)
                                          : readPlain(firstRow, rowCount, raw);
    if (status && mask_) status = applyMask(firstRow, rowCount, raw);
    return status;
  }

 private:
  Status transfer(GDALRasterBand& band, int firstRow, int rowCount, void* buffer, GDALDataType type) {
    GdalErrors errors;
    const int columns = band.GetXSize();
    if (band.RasterIO(GF_Read, 0, firstRow, columns, rowCount, buffer, columns, rowCount, type, 0, 0,
                      nullptr) == CE_None)
      return {};
    const std::string said = errors.firstFailure();
    return failure(ErrorCode::unreadable,
                   fmt::format("rows {} to {} cannot be read: {}", firstRow, firstRow + rowCount - 1,
                               said.empty() ? "GDAL gives no reason" : said));
  }

  Status readPlain(int firstRow, int rowCount, std::span<double> raw) {
    if (Status status = transfer(band_, firstRow, rowCount, raw.data(), GDT_Float64); !status) return status;
    for (double& value : raw) {
      if (signedByte_ && value > 127) value -= 256;
      if (nodata_(value)) value = kNan;
    }
    return {};
  }

  template <class Integer>
  Status readWide(int firstRow, int rowCount, std::span<double> raw) {
    std::vector<Integer> strip(raw.size());
    if (Status status = transfer(band_, firstRow, rowCount, strip.data(), type_); !status) return status;
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
        const std::size_t columns = std::size_t(band_.GetXSize());
        return failure(
            ErrorCode::invalidData,
            fmt::format(
                "the 64-bit height {} at column {}, row {} is beyond 2^53, so a double cannot hold it", value,
                i % columns, std::size_t(firstRow) + i / columns));
      }
      raw[i] = double(value);
    }
    return {};
  }

  Status applyMask(int firstRow, int rowCount, std::span<double> raw) {
    maskStrip_.resize(raw.size());
    if (Status status = transfer(*mask_, firstRow, rowCount, maskStrip_.data(), GDT_Byte); !status)
      return status;
    for (std::size_t i = 0; i < raw.size(); ++i)
      if (maskStrip_[i] == 0) raw[i] = kNan;
    return {};
  }

  GDALRasterBand& band_;
  GDALDataType type_;
  GDALRasterBand* mask_ = nullptr;
  bool signedByte_ = false;
  bool hasWideNodata_ = false;
  std::int64_t signedNodata_ = 0;
  std::uint64_t unsignedNodata_ = 0;
  NodataTest nodata_{std::nullopt, GDT_Float64};
  std::vector<std::uint8_t> maskStrip_;
};

int rowsPerStrip(GDALRasterBand& band) {
  int blockColumns = 0, blockRows = 0;
  band.GetBlockSize(&blockColumns, &blockRows);
  const std::size_t columns = std::size_t(band.GetXSize());
  std::size_t rows = std::max<std::size_t>(1, kStripSamples / columns);
  const std::size_t block = std::size_t(std::max(1, blockRows));
  if (block * columns <= kLargestStripSamples) rows = (rows + block - 1) / block * block;
  return int(std::min(rows, std::size_t(band.GetYSize())));
}

}  // namespace

Result<BandHeights> readBandHeights(GDALRasterBand& band, std::optional<double> nodata,
                                    std::vector<std::string>& warnings, const RunContext& context) {
  if (GDALDataTypeIsComplex(band.GetRasterDataType()))
    return failure(ErrorCode::unsupported,
                   fmt::format("band {} holds complex numbers ({}), not heights", band.GetBand(),
                               GDALGetDataTypeName(band.GetRasterDataType())));
  BandHeights result;
  result.scale = band.GetScale();
  result.offset = band.GetOffset();
  if (result.scale == 0 || !std::isfinite(result.scale) || !std::isfinite(result.offset))
    return failure(ErrorCode::invalidData, fmt::format("band {} declares the scale {} and the offset {}",
                                                       band.GetBand(), result.scale, result.offset));

  const std::size_t columns = std::size_t(band.GetXSize());
  const int rows = band.GetYSize(), stripRows = rowsPerStrip(band);
  reserveInPages(result.heights, columns * std::size_t(rows));
  StripReader reader(band, nodata);
  std::size_t infinite = 0, huge = 0;
  double hugeExample = 0;
  for (int row = 0; row < rows; row += stripRows) {
    if (context.cancelled()) return failure(ErrorCode::interrupted, "reading was stopped");
    context.report("reading", double(row) / rows);
    const int count = std::min(stripRows, rows - row);
    const std::size_t begin = result.heights.size();
    result.heights.resize(begin + columns * std::size_t(count));
    const std::span<double> strip = std::span(result.heights).subspan(begin);
    if (Status status = reader.read(row, count, strip); !status) return tl::unexpected(status.error());
    for (double& height : strip) {
      height = height * result.scale + result.offset;
      if (std::isinf(height)) {
        ++infinite;
        height = kNan;
      } else if (std::abs(height) > kHugeHeight) {
        ++huge;
        hugeExample = height;
      }
    }
  }
  context.report("reading", 1);
  if (infinite > 0) warnings.push_back(fmt::format("{} infinite heights are taken as NODATA", infinite));
  if (huge > 0)
    warnings.push_back(fmt::format(
        "{} heights are as large as {}: an undeclared NODATA value? `nodata` states it", huge, hugeExample));
  return result;
}

}  // namespace arete
