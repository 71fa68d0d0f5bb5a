// SPDX-License-Identifier: GPL-3.0-or-later
//
// GDAL opens the bytes as a file in memory, by the drivers of pictures only: a picture inside a mesh cannot
// name other files.
#include "io/formats/common/picture_pixels.h"

#include <cpl_vsi.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <string>

#include "io/geo/gdal/support.h"

namespace arete {
namespace {

constexpr const char* kDrivers[] = {"PNG", "JPEG", "WEBP", "GIF", "BMP", nullptr};

/// A file in memory that shares the bytes, as long as this lives.
class FileInMemory {
 public:
  explicit FileInMemory(std::span<const std::byte> bytes) {
    static std::atomic<unsigned> next{0};
    name_ = fmt::format("/vsimem/arete-picture-{}", next++);
    // It is only read.
    auto* data = reinterpret_cast<GByte*>(const_cast<std::byte*>(bytes.data()));
    if (VSILFILE* file = VSIFileFromMemBuffer(name_.c_str(), data, bytes.size(), FALSE)) VSIFCloseL(file);
  }
  FileInMemory(const FileInMemory&) = delete;
  FileInMemory& operator=(const FileInMemory&) = delete;
  ~FileInMemory() { VSIUnlink(name_.c_str()); }
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

class PictureReader {
 public:
  PictureReader(GDALDataset& picture, PicturePixels& into) : picture_(picture), pixels_(into) {}

  /// Reads a band into one of red, green, blue and alpha.
  bool read(int band, std::size_t channel) {
    GDALRasterBand& from = *picture_.GetRasterBand(band);
    const std::size_t count = pixels_.rgba.size();
    const bool isWide = from.GetRasterDataType() == GDT_UInt16;
    if (isWide) wide_.resize(count);
    const int width = static_cast<int>(pixels_.width), height = static_cast<int>(pixels_.height);
    std::uint8_t* narrow = pixels_.rgba.front().data() + channel;
    const CPLErr failed = isWide ? from.RasterIO(GF_Read, 0, 0, from.GetXSize(), from.GetYSize(),
                                                 wide_.data(), width, height, GDT_UInt16, 0, 0, nullptr)
                                 : from.RasterIO(GF_Read, 0, 0, from.GetXSize(), from.GetYSize(), narrow,
                                                 width, height, GDT_Byte, 4, GSpacing(4) * width, nullptr);
    if (failed != CE_None) return false;
    for (std::size_t i = 0; isWide && i < count; ++i)
      pixels_.rgba[i][channel] = static_cast<std::uint8_t>((wide_[i] * 255u + 32767u) / 65535u);
    return true;
  }

 private:
  GDALDataset& picture_;
  PicturePixels& pixels_;
  std::vector<std::uint16_t> wide_;
};

void applyColorTable(const GDALColorTable& table, PicturePixels& pixels) {
  for (auto& pixel : pixels.rgba) {
    GDALColorEntry entry{0, 0, 0, 255};
    if (pixel[0] < table.GetColorEntryCount()) entry = *table.GetColorEntry(pixel[0]);
    const auto byte = [](short value) { return static_cast<std::uint8_t>(std::clamp<int>(value, 0, 255)); };
    pixel = {byte(entry.c1), byte(entry.c2), byte(entry.c3), byte(entry.c4)};
  }
}

Result<GdalDatasetPtr> openPicture(const FileInMemory& file) {
  GdalDatasetPtr picture(
      GDALDataset::Open(file.name().c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, kDrivers, nullptr, nullptr));
  if (!picture || picture->GetRasterCount() < 1)
    return failure(ErrorCode::unsupported, "is no picture in PNG, JPEG, WebP, GIF or BMP");
  return picture;
}

}  // namespace

Result<std::array<std::uint32_t, 2>> pictureSize(std::span<const std::byte> bytes) {
  registerGdal();
  const FileInMemory file(bytes);
  const GdalErrors errors;
  ARETE_TRY(GdalDatasetPtr picture, openPicture(file));
  return std::array{static_cast<std::uint32_t>(picture->GetRasterXSize()),
                    static_cast<std::uint32_t>(picture->GetRasterYSize())};
}

Result<PicturePixels> decodePicture(std::span<const std::byte> bytes, std::uint32_t mostSide) {
  registerGdal();
  const FileInMemory file(bytes);
  const GdalErrors errors;
  ARETE_TRY(GdalDatasetPtr picture, openPicture(file));
  const auto width = static_cast<std::uint32_t>(picture->GetRasterXSize()),
             height = static_cast<std::uint32_t>(picture->GetRasterYSize());
  const int bands = picture->GetRasterCount();
  for (int b = 1; b <= bands; ++b)
    if (const GDALDataType type = picture->GetRasterBand(b)->GetRasterDataType();
        type != GDT_Byte && type != GDT_UInt16)
      return failure(ErrorCode::unsupported, "has neither 8 nor 16 bits a colour");
  PicturePixels pixels;
  const double coarser = std::max(1.0, double(std::max(width, height)) / std::max(mostSide, 1u));
  pixels.width = std::max(1u, static_cast<std::uint32_t>(width / coarser));
  pixels.height = std::max(1u, static_cast<std::uint32_t>(height / coarser));
  pixels.rgba.assign(std::size_t(pixels.width) * pixels.height, {0, 0, 0, 255});

  PictureReader reader(*picture, pixels);
  bool isRead = reader.read(1, 0);
  if (const GDALColorTable* table = picture->GetRasterBand(1)->GetColorTable(); isRead && table) {
    applyColorTable(*table, pixels);
  } else if (bands >= 3) {
    isRead = isRead && reader.read(2, 1) && reader.read(3, 2);
  } else if (isRead) {
    for (auto& pixel : pixels.rgba) pixel[1] = pixel[2] = pixel[0];
  }
  if (bands == 2 || bands >= 4) isRead = isRead && reader.read(bands == 2 ? 2 : 4, 3);
  if (!isRead || errors.anyFailure())
    return failure(ErrorCode::corrupt, "cannot be decoded: " + errors.firstFailure());
  return pixels;
}

}  // namespace arete
