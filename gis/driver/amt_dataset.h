// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gdal_priv.h>

#include <memory>
#include <string>

#include "engine/base/result.h"
#include "gis/driver/open_options.h"
#include "gis/driver/raster_band.h"
#include "gis/driver/triangle_layer.h"
#include "io/store/amt/container.h"

namespace arete {

/// An open .amt file: a band of heights, a layer of triangles, or both. It has no file beside it (.aux.xml,
/// .ovr): what is found out about it with one tolerance is not true of another.
class AmtDataset final : public GDALDataset {
 public:
  static int identify(GDALOpenInfo* info);
  /// @return null, and an error is said, where it cannot be opened
  static GDALDataset* open(GDALOpenInfo* info);

  CPLErr GetGeoTransform(double* transform) override;
  const OGRSpatialReference* GetSpatialRef() const override;
  int GetLayerCount() override { return layer_ ? 1 : 0; }
  OGRLayer* GetLayer(int number) override { return number == 0 ? layer_.get() : nullptr; }
  int TestCapability(const char*) override { return FALSE; }

 protected:
  /// That of the band: GDAL's own would take overviews and shift windows to whole pixels.
  CPLErr IRasterIO(GDALRWFlag mode, int left, int top, int width, int height, void* buffer, int bufferColumns,
                   int bufferRows, GDALDataType type, int bandCount, int* bands, GSpacing pixelStep,
                   GSpacing lineStep, GSpacing bandStep, GDALRasterIOExtraArg* extra) override;

 private:
  Status openTerrain(AmtContainer container, const DriverOptions& options, bool wantsRaster, bool wantsLayer);
  Status openSurface(const AmtContainer& container, const DriverOptions& options, bool wantsLayer);
  Status takeCrs(const std::string& wkt);

  std::shared_ptr<TerrainCuts> cuts_;
  OGRSpatialReference crs_;
  std::unique_ptr<TriangleLayer> layer_;
  bool hasPosition_ = false;
};

}  // namespace arete
