// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/base/result.h"

namespace arete {

/// True for the name of a zip archive that is not yet one of GDAL's virtual paths.
bool isPlainZip(const std::string& path);

/// GDAL's name of the one raster in a zip archive ("/vsizip/{archive.zip}/N48W125.hgt"): drivers that read
/// the place from the file's name, as SRTM's does, must see the name inside. Where there is no raster proper,
/// a text of numbers is one. Errors: notFound, unreadable, corrupt (no zip archive), unsupported (no raster
/// inside, or several: listed).
Result<std::string> findZippedRaster(const std::string& archive);

/// What GDAL opens for a path: that of the one raster in it for a plain zip archive, else itself. Errors: as
/// findZippedRaster().
Result<std::string> rasterPathOf(const std::string& path);

}  // namespace arete
