// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// @return True for a name that ends in .zip and is not one of GDAL's virtual paths but "/vsicurl/...".
bool isPlainZip(const std::string& path);

/// Finds the only raster in a zip archive. A text of numbers counts as a raster if there is no other.
///
/// @return GDAL's path of it: "/vsizip/{archive.zip}/N48W125.hgt". Drivers that take the position from the
/// file's name, such as SRTMHGT, need the name inside the archive.
///
/// Errors: notFound, unreadable. corrupt: not a zip archive. unsupported: no raster inside, or several; lists
/// them. interrupted.
Result<std::string> findZippedRaster(const std::string& archive, const RunContext& context = {});

/// @return The path for GDAL to open: for a zip archive, that of the only raster in it; otherwise the path
/// itself. Errors: those of findZippedRaster().
Result<std::string> rasterPathOf(const std::string& path, const RunContext& context = {});

}  // namespace arete
