// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"

namespace arete {

/// The bytes of a plain file, also in one of GDAL's virtual file systems; nothing of others.
std::optional<std::uint64_t> fileLength(const std::string& path);

/// Errors: unreadable: fewer bytes are there than are wanted; the message has both numbers, and `what` states
/// them.
Status checkLength(std::uint64_t wanted, std::uint64_t there, const std::string& what);

/// The number of bytes that the header of a classic netCDF file (CDF-1, -2 or -5) states.
///
/// @return Nothing for other files and for headers that cannot be followed. O(header).
std::optional<std::uint64_t> classicNetcdfLength(const std::string& path);

/// Holds the length of a file against the one that its header states: classic netCDF, DTED, PCRaster,
/// PCIDSK, SQLite (GeoPackage, MBTiles), DGN, CALS, and files named as .hgt tiles are. Other files pass.
///
/// Errors: unreadable: the file is shorter; the message has both numbers.
Status checkLengthByContent(const std::string& path);

/// Warns where the length of a file does not say whether it is whole: PCIDSK in tiles, CALS without the mark
/// of its end.
void warnOfLength(const std::string& path, Warnings& warnings);

}  // namespace arete
