// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/result.h"

namespace arete {

/// True for the name of a zip archive that is not yet one of GDAL's virtual paths.
bool isPlainZip(const std::string& path);

/// GDAL's name of the one raster in a zip archive ("/vsizip/{archive.zip}/N48W125.hgt"): drivers that read
/// the place from the file's name, as SRTM's does, must see the name inside. Errors: notFound, unreadable,
/// corrupt (no zip archive), unsupported (no raster inside, or several: listed).
Result<std::string> findZippedRaster(const std::string& archive);

}  // namespace arete
