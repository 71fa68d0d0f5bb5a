// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gdal_priv.h>

#include <memory>
#include <string>

#include "gis/driver/terrain_cuts.h"

namespace arete {

/// Heights of a terrain, or an overview of them. Every read of whatever window and size gives the surface at
/// the middle of each pixel asked for: of the cut that suits its size.
class HeightBand final : public GDALRasterBand {
 public:
  /// @param overview 0: the grid itself
  HeightBand(GDALDataset* dataset, std::shared_ptr<TerrainCuts> cuts, int overview);
  /// Adds an overview, of the grid itself.
  void addOverview(std::unique_ptr<HeightBand> overview) { overviews_.push_back(std::move(overview)); }

  double GetNoDataValue(int* isKnown) override;
  const char* GetUnitType() override;
  int GetOverviewCount() override { return static_cast<int>(overviews_.size()); }
  GDALRasterBand* GetOverview(int number) override;

 protected:
  CPLErr IReadBlock(int column, int row, void* heights) override;
  CPLErr IRasterIO(GDALRWFlag mode, int left, int top, int width, int height, void* buffer, int bufferColumns,
                   int bufferRows, GDALDataType type, GSpacing pixelStep, GSpacing lineStep,
                   GDALRasterIOExtraArg* extra) override;

 private:
  /// @param window in pixels of this band
  CPLErr fill(PixelWindow window, std::span<double> heights);
  double errorFor(const PixelWindow& window) const;

  std::shared_ptr<TerrainCuts> cuts_;
  std::vector<std::unique_ptr<HeightBand>> overviews_;
};

}  // namespace arete
