// SPDX-License-Identifier: GPL-3.0-or-later
#include "gis/driver/raster_band.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "gis/driver/gdal_errors.h"

namespace arete {
namespace {

constexpr int kBlock = 256;
/// Samples that are computed at once.
constexpr int kStripSamples = 1 << 22;

}  // namespace

HeightBand::HeightBand(GDALDataset* dataset, std::shared_ptr<TerrainCuts> cuts, int overview)
    : cuts_(std::move(cuts)) {
  const auto part = [&](int size) {
    return static_cast<int>(std::max(1.0, std::ceil(std::ldexp(double(size), -overview))));
  };
  poDS = dataset;
  nBand = overview == 0 ? 1 : 0;
  nRasterXSize = part(cuts_->grid().columns);
  nRasterYSize = part(cuts_->grid().rows);
  eDataType = GDT_Float64;
  nBlockXSize = std::min(kBlock, nRasterXSize);
  nBlockYSize = std::min(kBlock, nRasterYSize);
  eAccess = GA_ReadOnly;
  if (overview > 0)
    SetMetadataItem("ERROR", CPLSPrintf("%.9g", cuts_->errorOfOverview(overview)));
  else
    SetDescription("height");
}

double HeightBand::GetNoDataValue(int* isKnown) {
  if (isKnown != nullptr) *isKnown = TRUE;
  return std::numeric_limits<double>::quiet_NaN();
}

const char* HeightBand::GetUnitType() {
  return cuts_->outline().georeference.verticalUnit.c_str();
}

GDALRasterBand* HeightBand::GetOverview(int number) {
  return number >= 0 && number < GetOverviewCount() ? overviews_[static_cast<std::size_t>(number)].get()
                                                    : nullptr;
}

double HeightBand::errorFor(const PixelWindow& window) const {
  const double pixels = std::min(window.width / window.columns, window.height / window.rows);
  const int level = pixels > 1 ? static_cast<int>(std::floor(std::log2(pixels) + 1e-9)) : 0;
  return cuts_->errorOfOverview(level);
}

CPLErr HeightBand::fill(PixelWindow window, std::span<double> heights) {
  // In pixels of the grid.
  const double across = double(cuts_->grid().columns) / nRasterXSize,
               down = double(cuts_->grid().rows) / nRasterYSize;
  window.left *= across;
  window.width *= across;
  window.top *= down;
  window.height *= down;
  const Status filled = cuts_->fill(window, errorFor(window), heights);
  if (filled) return CE_None;
  reportError(filled.error());
  return CE_Failure;
}

CPLErr HeightBand::IReadBlock(int column, int row, void* heights) {
  const int left = column * nBlockXSize, top = row * nBlockYSize;
  const int columns = std::min(nBlockXSize, nRasterXSize - left),
            rows = std::min(nBlockYSize, nRasterYSize - top);
  std::vector<double> part(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  const CPLErr done = fill({double(left), double(top), double(columns), double(rows), columns, rows}, part);
  for (int r = 0; r < rows; ++r)
    std::copy_n(part.begin() + static_cast<std::ptrdiff_t>(r) * columns, columns,
                static_cast<double*>(heights) + static_cast<std::ptrdiff_t>(r) * nBlockXSize);
  return done;
}

CPLErr HeightBand::IRasterIO(GDALRWFlag mode, int left, int top, int width, int height, void* buffer,
                             int bufferColumns, int bufferRows, GDALDataType type, GSpacing pixelStep,
                             GSpacing lineStep, GDALRasterIOExtraArg* extra) {
  if (mode != GF_Read) {
    CPLError(CE_Failure, CPLE_NotSupported, "an .amt file is only read");
    return CE_Failure;
  }
  const bool isWhole =
      extra == nullptr || extra->bFloatingPointWindowValidity == FALSE ||
      (extra->dfXOff == left && extra->dfYOff == top && extra->dfXSize == width && extra->dfYSize == height);
  // Pixels as they are, few at once: by blocks, which GDAL keeps.
  if (isWhole && width == bufferColumns && height == bufferRows &&
      double(width) * double(height) < 4.0 * kBlock * kBlock)
    return GDALRasterBand::IRasterIO(mode, left, top, width, height, buffer, bufferColumns, bufferRows, type,
                                     pixelStep, lineStep, extra);
  PixelWindow all{double(left), double(top), double(width), double(height), bufferColumns, bufferRows};
  if (extra != nullptr && extra->bFloatingPointWindowValidity != FALSE)
    all = {extra->dfXOff, extra->dfYOff, extra->dfXSize, extra->dfYSize, bufferColumns, bufferRows};
  const int strip = std::max(1, kStripSamples / bufferColumns);
  std::vector<double> heights;
  for (int row = 0; row < bufferRows; row += strip) {
    const int rows = std::min(strip, bufferRows - row);
    heights.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(bufferColumns));
    PixelWindow window = all;
    window.top += all.height * row / bufferRows;
    window.height = all.height * rows / bufferRows;
    window.rows = rows;
    if (const CPLErr failed = fill(window, heights); failed != CE_None) return failed;
    for (int r = 0; r < rows; ++r)
      GDALCopyWords64(heights.data() + static_cast<std::ptrdiff_t>(r) * bufferColumns, GDT_Float64,
                      sizeof(double), static_cast<GByte*>(buffer) + lineStep * (row + r), type,
                      static_cast<int>(pixelStep), bufferColumns);
    if (extra != nullptr && extra->pfnProgress != nullptr &&
        extra->pfnProgress(double(row + rows) / bufferRows, "", extra->pProgressData) == FALSE) {
      CPLError(CE_Failure, CPLE_UserInterrupt, "interrupted");
      return CE_Failure;
    }
  }
  return CE_None;
}

}  // namespace arete
