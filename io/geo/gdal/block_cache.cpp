// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/gdal/block_cache.h"

#include <gdal.h>

#include <algorithm>

namespace arete {

void boundGdalCache(std::uint64_t bytes) {
  GDALSetCacheMax64(std::min<GIntBig>(GDALGetCacheMax64(), static_cast<GIntBig>(bytes)));
}

}  // namespace arete
