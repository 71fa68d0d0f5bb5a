// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "io/gdal/support.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// Where a picture comes to lie on a terrain.
struct DrapePlacement {
  Vec2 scale, shift;  ///< of plan positions, to pixels of the picture that is read
  std::uint32_t columns = 0, rows = 0;
  double coarser = 1;     ///< pixels of the file along a side of one that is read, about
  bool isExact = false;   ///< its pixels are those of the file
  bool isWarped = false;  ///< by a change of CRS, or ground control points
  std::array<double, 4>
      window{};  ///< of the file's pixels that it needs: first and end column, first and end row
};

struct TransformerCloser {
  void operator()(void* transformer) const;
};
/// Of GDAL's: pixels of a file and coordinates of the terrain's CRS.
using TransformerPtr = std::unique_ptr<void, TransformerCloser>;

/// Errors: invalidData (no georeference; no CRS where the terrain has one; no way between the two).
Result<TransformerPtr> drapeTransformer(GDALDataset& picture, const TerrainModel& model,
                                        std::vector<std::string>& warnings);

/// At most about `mostPixels` (at least 1) are read: more of them are read coarser. Errors: invalidData,
/// where the picture and the terrain do not overlap; unsupported, where it is too long and thin.
Result<DrapePlacement> placeDrape(GDALDataset& picture, void* transformer, const TerrainModel& model,
                                  std::uint64_t mostPixels);

}  // namespace arete
