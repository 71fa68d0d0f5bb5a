// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which formats are here was found by cutting a file of every format that GDAL writes
// (tests/io/dem/cut_files_test.cpp): these are read as zeros, as garbage, or with a message without numbers.
#include "io/dem/declared_length.h"

#include <cpl_conv.h>
#include <cpl_minixml.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <rawdataset.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstring>
#include <string_view>

#include "io/file/text_scan.h"

namespace arete {
namespace {

constexpr int kDeepestNesting = 8;

using Head = std::array<unsigned char, 512>;

std::optional<std::uint64_t> lengthOf(const std::string& path) {
  VSIStatBufL status;
  if (VSIStatL(path.c_str(), &status) != 0 || !VSI_ISREG(status.st_mode)) return std::nullopt;
  return std::uint64_t(status.st_size);
}

std::size_t readHead(const std::string& path, Head& head) {
  head.fill(0);
  VSILFILE* file = VSIFOpenL(path.c_str(), "rb");
  if (!file) return 0;
  const std::size_t got = VSIFReadL(head.data(), 1, head.size(), file);
  VSIFCloseL(file);
  return got;
}

std::string_view textOf(const Head& head, std::size_t begin, std::size_t count) {
  return {reinterpret_cast<const char*>(head.data()) + begin, count};
}

/// A number in a field of text, spaces before it; nothing if there is none.
std::optional<std::uint64_t> numberIn(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end != text.data() ? std::optional(value) : std::nullopt;
}

std::uint64_t bigEndian(const Head& head, std::size_t begin, int bytes) {
  std::uint64_t value = 0;
  for (int i = 0; i < bytes; ++i) value = value << 8 | head[begin + std::size_t(i)];
  return value;
}

std::uint64_t littleEndian(const Head& head, std::size_t begin, int bytes) {
  std::uint64_t value = 0;
  for (int i = bytes; i-- > 0;) value = value << 8 | head[begin + std::size_t(i)];
  return value;
}

/// A user header label, perhaps after the labels of a tape; one record for each column.
std::optional<std::uint64_t> dtedLength(const Head& head) {
  constexpr std::uint64_t kLabel = 80, kDescriptions = 648 + 2700;
  for (std::size_t begin : {0, 80, 160}) {
    if (textOf(head, begin, 4) != "UHL1") continue;
    const auto columns = numberIn(textOf(head, begin + 47, 4)), rows = numberIn(textOf(head, begin + 51, 4));
    if (!columns || !rows) return std::nullopt;
    return begin + kLabel + kDescriptions + *columns * (12 + 2 * *rows);
  }
  return std::nullopt;
}

/// Cells follow a header of 256 bytes; the lowest bits of their type are the logarithm of their size.
std::optional<std::uint64_t> pcrasterLength(const Head& head) {
  if (textOf(head, 0, 27) != "RUU CROSS SYSTEM MAP FORMAT") return std::nullopt;
  const bool isLittle = littleEndian(head, 46, 4) == 1;
  const auto number = [&](std::size_t begin, int bytes) {
    return isLittle ? littleEndian(head, begin, bytes) : bigEndian(head, begin, bytes);
  };
  return 256 + number(100, 4) * number(104, 4) * (std::uint64_t(1) << (number(66, 2) & 3));
}

/// The header counts blocks of 512 bytes. Tiles are counted in advance, before they are written.
std::optional<std::uint64_t> pcidskLength(const Head& head, bool isTiled) {
  if (textOf(head, 0, 8) != "PCIDSK  " || (textOf(head, 360, 4) == "FILE") != isTiled) return std::nullopt;
  const auto blocks = numberIn(textOf(head, 16, 16));
  return blocks ? std::optional(*blocks * 512) : std::nullopt;
}

/// The count of pages is valid where two counters of changes agree.
std::optional<std::uint64_t> sqliteLength(const Head& head) {
  if (std::memcmp(head.data(), "SQLite format 3", 16) != 0) return std::nullopt;
  const std::uint64_t page = bigEndian(head, 16, 2);
  if (bigEndian(head, 24, 4) != bigEndian(head, 92, 4)) return std::nullopt;
  return (page == 1 ? 65536 : page) * bigEndian(head, 28, 4);
}

bool isNamedAsTile(const std::string& path) {
  const std::string name = text::lowered(CPLGetFilename(path.c_str()));
  const auto digits = [&](std::size_t begin, std::size_t count) {
    return std::all_of(name.begin() + std::ptrdiff_t(begin), name.begin() + std::ptrdiff_t(begin + count),
                       [](unsigned char c) { return std::isdigit(c) != 0; });
  };
  return name.size() == 11 && name.ends_with(".hgt") && (name[0] == 'n' || name[0] == 's') && digits(1, 2) &&
         (name[3] == 'e' || name[3] == 'w') && digits(4, 3);
}

/// A tile of SRTM has no header: its length is its resolution.
Status checkTile(const std::string& path, std::uint64_t length) {
  constexpr std::uint64_t kOneSecond = 2ull * 3601 * 3601, kThreeSeconds = 2ull * 1201 * 1201;
  if (!isNamedAsTile(path) || length == 0) return {};
  const GdalErrors quiet;
  GDALDriverH driver = GDALIdentifyDriverEx(path.c_str(), GDAL_OF_RASTER, nullptr, nullptr);
  if (driver && !isTextDriver(driver)) return {};
  return failure(
      ErrorCode::unreadable,
      fmt::format(
          "is cut short or no tile of heights: it has {} bytes; a tile of 1 second has {}, of 3 seconds {}",
          length, kOneSecond, kThreeSeconds));
}

Status compare(std::uint64_t wanted, std::uint64_t there, const std::string& what) {
  if (there >= wanted) return {};
  return failure(ErrorCode::unreadable,
                 fmt::format("is cut short: {} states {} bytes and {} are there", what, wanted, there));
}

/// The end of the samples of a raw band in its file.
std::uint64_t endOf(const RawRasterBand& band, int columns, int rows) {
  std::int64_t last = 0;
  for (const std::int64_t x : {0, columns - 1})
    for (const std::int64_t y : {0, rows - 1})
      last = std::max(last, x * band.GetPixelOffset() + y * band.GetLineOffset());
  return band.GetImgOffset() + std::uint64_t(last) +
         std::uint64_t(GDALGetDataTypeSizeBytes(const_cast<RawRasterBand&>(band).GetRasterDataType()));
}

Status checkRawBands(GDALDataset& dataset) {
  for (int b = 1; b <= dataset.GetRasterCount(); ++b) {
    const auto* raw = dynamic_cast<const RawRasterBand*>(dataset.GetRasterBand(b));
    if (!raw || !raw->GetFPL()) continue;
    const vsi_l_offset at = VSIFTellL(raw->GetFPL());
    VSIFSeekL(raw->GetFPL(), 0, SEEK_END);
    const std::uint64_t there = VSIFTellL(raw->GetFPL());
    VSIFSeekL(raw->GetFPL(), at, SEEK_SET);
    GDALDataset::RawBinaryLayout layout;
    const std::string name =
        dataset.GetRawBinaryLayout(layout) ? CPLGetFilename(layout.osRawFilename.c_str()) : "";
    const bool isOther = !name.empty() && name != CPLGetFilename(dataset.GetDescription());
    if (Status status = compare(endOf(*raw, dataset.GetRasterXSize(), dataset.GetRasterYSize()), there,
                                isOther ? fmt::format("its header, of the file '{}',", name) : "its header");
        !status)
      return status;
  }
  return {};
}

struct XmlCloser {
  void operator()(CPLXMLNode* node) const { CPLDestroyXMLNode(node); }
};

/// The raw bands of a virtual raster: GDAL reads what its file lacks as zeros.
Status checkVirtualRawBands(GDALDataset& dataset) {
  char** xml = dataset.GetMetadata("xml:VRT");
  if (!xml || !xml[0]) return {};
  const std::unique_ptr<CPLXMLNode, XmlCloser> tree(CPLParseXMLString(xml[0]));
  const CPLXMLNode* root = tree ? CPLGetXMLNode(tree.get(), "=VRTDataset") : nullptr;
  for (const CPLXMLNode* node = root ? root->psChild : nullptr; node; node = node->psNext) {
    if (!EQUAL(node->pszValue, "VRTRasterBand") ||
        !EQUAL(CPLGetXMLValue(node, "subClass", ""), "VRTRawRasterBand"))
      continue;
    std::string name = CPLGetXMLValue(node, "SourceFilename", "");
    if (std::strcmp(CPLGetXMLValue(node, "SourceFilename.relativeToVRT", "1"), "1") == 0)
      name = CPLProjectRelativeFilename(CPLGetDirname(dataset.GetDescription()), name.c_str());
    const auto there = lengthOf(name);
    const std::int64_t size =
        GDALGetDataTypeSizeBytes(GDALGetDataTypeByName(CPLGetXMLValue(node, "dataType", "Byte")));
    const std::int64_t columns = dataset.GetRasterXSize(), rows = dataset.GetRasterYSize();
    const auto number = [&](const char* field, std::int64_t otherwise) {
      const char* value = CPLGetXMLValue(node, field, nullptr);
      return value ? std::int64_t(CPLAtoGIntBig(value)) : otherwise;
    };
    const std::int64_t pixel = number("PixelOffset", size), line = number("LineOffset", pixel * columns);
    const std::int64_t last =
        std::max<std::int64_t>(0, (columns - 1) * pixel) + std::max<std::int64_t>(0, (rows - 1) * line);
    if (!there) continue;
    if (Status status =
            compare(std::uint64_t(number("ImageOffset", 0) + last + size), *there,
                    fmt::format("its band of raw samples, of the file '{}',", CPLGetFilename(name.c_str())));
        !status)
      return status;
  }
  return {};
}

bool isDriver(GDALDriverH driver, std::string_view name) {
  return driver && name == GDALGetDriverShortName(driver);
}

Status checkFilesOf(GDALDataset& dataset, int nesting);

/// A file that a virtual raster reads.
Status checkSource(const std::string& path, int nesting) {
  const GdalErrors quiet;
  GDALDriverH driver = GDALIdentifyDriverEx(path.c_str(), GDAL_OF_RASTER, nullptr, nullptr);
  if (!isDriver(driver, "ENVI") && !isDriver(driver, "VRT") && !isDriver(driver, "GTiff")) return {};
  const GdalDatasetPtr source = openRasterForLength(path);
  if (!source || source->GetRasterCount() == 0) return {};
  if (isDriver(driver, "GTiff")) {
    GDALRasterBand& band = *source->GetRasterBand(1);
    int isDeclared = 0;
    band.GetNoDataValue(&isDeclared);
    const int status = band.GetDataCoverageStatus(0, 0, band.GetXSize(), band.GetYSize(), 0, nullptr);
    if (isDeclared || (status & GDAL_DATA_COVERAGE_STATUS_EMPTY) == 0) return {};
    return failure(
        ErrorCode::unsupported,
        fmt::format("reads the file '{}', which leaves blocks out and declares no NODATA: they would be "
                    "heights of 0. Name the file itself, or declare its NODATA",
                    CPLGetFilename(path.c_str())));
  }
  return checkFilesOf(*source, nesting + 1);
}

Status checkFilesOf(GDALDataset& dataset, int nesting) {
  if (Status status = checkRawBands(dataset); !status) return status;
  if (Status status = checkVirtualRawBands(dataset); !status) return status;
  const bool isVirtual = dataset.GetDriver() && EQUAL(dataset.GetDriver()->GetDescription(), "VRT");
  const CPLStringList files(dataset.GetFileList());
  for (int i = 0; i < files.Count(); ++i) {
    const std::string file = files[i];
    if (file == dataset.GetDescription()) continue;
    if (Status status = checkLengthByContent(file); !status)
      return failure(status.error().code,
                     fmt::format("its file '{}' {}", CPLGetFilename(file.c_str()), status.error().message));
    if (!isVirtual || nesting >= kDeepestNesting) continue;
    if (Status status = checkSource(file, nesting); !status) return status;
  }
  return {};
}

}  // namespace

Status checkLengthByContent(const std::string& path) {
  const GdalErrors quiet;
  Head head;
  if (readHead(path, head) == 0) return {};
  const auto there = lengthOf(path);
  if (!there) return {};
  for (const auto& wanted :
       {dtedLength(head), pcrasterLength(head), pcidskLength(head, false), sqliteLength(head)})
    if (wanted) return compare(*wanted, *there, "its header");
  if (textOf(head, 0, 3) == "CDF" && (head[3] == 1 || head[3] == 2 || head[3] == 5)) {
    if (const auto wanted = classicNetcdfLength(path)) return compare(*wanted, *there, "its header");
    return failure(
        ErrorCode::unreadable,
        fmt::format("is cut short or damaged: its header does not end within the {} bytes that are there",
                    *there));
  }
  return checkTile(path, *there);
}

void warnOfLength(const std::string& path, std::vector<std::string>& warnings) {
  const GdalErrors quiet;
  Head head;
  if (readHead(path, head) == 0) return;
  const auto wanted = pcidskLength(head, true), there = lengthOf(path);
  if (wanted && there && *wanted > *there)
    warnings.push_back(fmt::format(
        "its header counts {} bytes and {} are there: tiles that were not written, or have been cut off, "
        "are heights of 0",
        *wanted, *there));
}

GdalDatasetPtr openRasterForLength(const std::string& path) {
  constexpr const char* kOption = "RAW_CHECK_FILE_SIZE";
  const char* before = CPLGetThreadLocalConfigOption(kOption, nullptr);
  const std::optional<std::string> kept = before ? std::optional<std::string>(before) : std::nullopt;
  CPLSetThreadLocalConfigOption(kOption, "NO");
  GdalDatasetPtr dataset = openGdal(path, GDAL_OF_RASTER);
  CPLSetThreadLocalConfigOption(kOption, kept ? kept->c_str() : nullptr);
  return dataset;
}

Status checkDeclaredLength(GDALDataset& dataset) {
  const GdalErrors quiet;
  return checkFilesOf(dataset, 0);
}

}  // namespace arete
