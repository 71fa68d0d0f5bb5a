// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gdal_priv.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "io/gdal/support.h"

namespace arete {

/// The number of bytes that the header of a classic netCDF file (CDF-1, -2 or -5) states.
///
/// @return Nothing for other files and for headers that cannot be followed. O(header).
std::optional<std::uint64_t> classicNetcdfLength(const std::string& path);

/// Holds the length of a file against the one that its header states: classic netCDF, DTED, PCRaster,
/// PCIDSK, SQLite (GeoPackage, MBTiles), and files named as .hgt tiles are. Other files pass.
///
/// Errors: unreadable: the file is shorter; the message has both numbers.
Status checkLengthByContent(const std::string& path);

/// Warns where the length of a file does not say whether it is whole: PCIDSK in tiles.
void warnOfLength(const std::string& path, std::vector<std::string>& warnings);

/// Opens a raster as openGdal() does, except that GDAL's own check of raw files, whose message has no
/// numbers, is left to checkDeclaredLength().
GdalDatasetPtr openRasterForLength(const std::string& path);

/// The same for a raster that is open: the files of raw samples that its bands read (ENVI and other pairs of
/// a header and data, raw bands of virtual rasters), and the files that it consists of. Also refuses a
/// virtual raster over a sparse file without NODATA, whose absent blocks it would read as 0.
///
/// Errors: unreadable, unsupported.
Status checkDeclaredLength(GDALDataset& dataset);

}  // namespace arete
