// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/base/warning.h"
#include "io/geo/gdal/support.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// The mapping of an image onto a terrain.
struct DrapePlacement {
  Vec2 scale, shift;  ///< pixel = plan position * scale + shift, in the image that is read
  std::uint32_t columns = 0, rows = 0;
  double coarser = 1;     ///< side of a pixel that is read, in pixels of the file, approximately
  bool isExact = false;   ///< pixels are copied from the file, not interpolated
  bool isWarped = false;  ///< by a CRS transformation or ground control points
  std::array<double, 4>
      window{};  ///< the pixels of the file that are needed: first and end column, first and end row
};

struct TransformerCloser {
  void operator()(void* transformer) const;
};
/// A GDAL transformer between pixels of a file and coordinates of the terrain's CRS.
using TransformerPtr = std::unique_ptr<void, TransformerCloser>;

/// Errors: invalidData: no georeference; no CRS while the terrain has one; no transformation between the two.
Result<TransformerPtr> drapeTransformer(GDALDataset& picture, const TerrainModel& model, Warnings& warnings);

/// @param maxPixels At least 1. A larger image is read at a coarser resolution, of about so many pixels.
///
/// Errors: invalidData: the image and the terrain do not overlap. unsupported: the image is too long and
/// thin.
Result<DrapePlacement> placeDrape(GDALDataset& picture, void* transformer, const TerrainModel& model,
                                  std::uint64_t maxPixels);

}  // namespace arete
