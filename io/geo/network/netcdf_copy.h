// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace arete {

/// GDAL's driver of netCDF waits for pages of a file of the network that never come when the connection is
/// lost. So such a file is copied into memory as a whole.
///
/// @param path As servedPath() returns it.
/// @return The path for GDAL to open; `path` itself for other files, and where the copy fails, which is an
/// error of GDAL. removeNetworkCopy() takes the description of the dataset, after it is closed.
std::string pathWithoutNetcdf(const std::string& path);
void removeNetworkCopy(const std::string& description);

}  // namespace arete
