// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "terrain/model/build_options.h"

namespace arete {

/// How a large mesh is divided into tiles, each simplified by one thread (simplify.h). The MT depends on
/// these values and a model does not record them, so they are constants: only tests, whose rasters are small,
/// state others (buildInTiles()).
struct TileOptions {
  std::uint32_t most = 1 << 13;   ///< vertices of a tile; its data takes about 1 MB. >= least
  std::uint32_t least = 1 << 12;  ///< vertices of a tile where larger ones would be too few. > 0
  std::uint32_t fewest = 8;       ///< tiles; a mesh with fewer is simplified by all threads together. > 0
  double span = 1.5;              ///< growth of the threshold over the levels of one pass over the tiles. > 1

  /// The values that build() takes. The data-dependent shape takes a smaller span: its cuts then have some
  /// thousandths fewer triangles at about the same time (docs/decisions/0018).
  static TileOptions of(HoleShape shape) {
    TileOptions options;
    if (shape == HoleShape::dataDependent) options.span = 1.35;
    return options;
  }
};

}  // namespace arete
