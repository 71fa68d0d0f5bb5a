// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which formats are here was found by cutting a file of every format that GDAL writes
// (tests/io/geo/dem/cut_files_test.cpp).
#include "io/geo/dem/declared_length.h"

#include <cpl_conv.h>
#include <cpl_minixml.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <rawdataset.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "io/files/text_scan.h"
#include "io/geo/gdal/file_length.h"
#include "io/geo/network/network_path.h"

namespace arete {
namespace {

constexpr int kDeepestNesting = 8;

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
    if (Status status =
            checkLength(endOf(*raw, dataset.GetRasterXSize(), dataset.GetRasterYSize()), there,
                        isOther ? fmt::format("its header, of the file '{}',", name) : "its header");
        !status)
      return status;
  }
  return {};
}

/// The blocks of an HFA may be in a file beside it (.ige): a header, a map of blocks for each layer, then the
/// blocks of all layers, which are never compressed. GDAL reads what is missing as 0.
std::uint64_t spilledLength(GDALDataset& dataset) {
  constexpr std::uint64_t kHeader = 49, kMapHeader = 20;
  std::uint64_t length = kHeader;
  for (int b = 1; b <= dataset.GetRasterCount(); ++b) {
    GDALRasterBand& band = *dataset.GetRasterBand(b);
    int blockColumns = 1, blockRows = 1;
    band.GetBlockSize(&blockColumns, &blockRows);
    const auto blocks = [](int count, int size) {
      return std::uint64_t((count - 1) / std::max(1, size) + 1);
    };
    const std::uint64_t across = blocks(dataset.GetRasterXSize(), blockColumns),
                        down = blocks(dataset.GetRasterYSize(), blockRows);
    const char* stated = band.GetMetadataItem("NBITS", "IMAGE_STRUCTURE");
    const auto bits = stated ? std::uint64_t(std::atoi(stated))
                             : std::uint64_t(GDALGetDataTypeSizeBits(band.GetRasterDataType()));
    const std::uint64_t blockBytes = (std::uint64_t(blockColumns) * std::uint64_t(blockRows) * bits + 7) / 8;
    length += kMapHeader + (across + 7) / 8 * down + across * down * blockBytes;
  }
  return length;
}

Status checkSpilled(GDALDataset& dataset, const std::string& file) {
  const auto there = fileLength(file);
  return there ? checkLength(spilledLength(dataset), *there, "the file of its header") : Status();
}

/// The samples of an ILWIS map are a file of rows without a header.
Status checkIlwis(GDALDataset& dataset) {
  const std::string file = CPLResetExtension(dataset.GetDescription(), "mp#");
  const auto there = fileLength(file);
  const std::uint64_t samples =
      std::uint64_t(dataset.GetRasterXSize()) * std::uint64_t(dataset.GetRasterYSize());
  if (!there || *there % samples == 0) return {};
  return checkLength((*there / samples + 1) * samples, *there,
                     fmt::format("its header, of the file '{}',", CPLGetFilename(file.c_str())));
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
    const auto there = fileLength(name);
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
    ARETE_CHECK(
        checkLength(std::uint64_t(number("ImageOffset", 0) + last + size), *there,
                    fmt::format("its band of raw samples, of the file '{}',", CPLGetFilename(name.c_str()))));
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
  GDALDriverH driver = GDALIdentifyDriverEx(servedPath(path).c_str(), GDAL_OF_RASTER, nullptr, nullptr);
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
  ARETE_CHECK(checkRawBands(dataset));
  ARETE_CHECK(checkVirtualRawBands(dataset));
  const std::string driver = dataset.GetDriver() ? dataset.GetDriver()->GetDescription() : "";
  const bool isVirtual = driver == "VRT";
  if (driver == "ILWIS") ARETE_CHECK(checkIlwis(dataset));
  const CPLStringList files(dataset.GetFileList());
  for (int i = 0; i < files.Count(); ++i) {
    const std::string file = files[i];
    if (file == dataset.GetDescription()) continue;
    const bool isSpilled = driver == "HFA" && text::lowerExtension(file) == "ige";
    if (Status whole = isSpilled ? checkSpilled(dataset, file) : checkLengthByContent(file); !whole)
      return failure(whole.error().code,
                     fmt::format("its file '{}' {}", CPLGetFilename(file.c_str()), whole.error().message));
    if (!isVirtual || nesting >= kDeepestNesting) continue;
    ARETE_CHECK(checkSource(file, nesting));
  }
  return {};
}

}  // namespace

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
