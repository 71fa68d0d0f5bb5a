// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace arete {

/// @return "/vsicurl/http..." for an address, as GDAL names it; any other path as it is.
std::string networkPathOf(const std::string& path);

/// The path under which GDAL reads what a person names, so that addresses are read by checked requests
/// (io/geo/network/served_files.h): an address, and each "/vsicurl/http..." or "/vsicurl?..." in the path,
/// gets the prefix of our own, also within another path ("/vsizip//vsicurl/...", "NETCDF:...", "vrt://...").
/// Other paths stay, and all of them where nothing is read over the network. Every path that a person or a
/// file states goes through this before GDAL gets it. O(path).
std::string servedPath(const std::string& path);

/// Whether a name begins with an address ("https://...").
bool beginsWithAddress(std::string_view name);

/// Whether a path that servedPath() returned reads a file of the network.
bool isServedAddress(const std::string& path);

/// The reverse, for sentences: a text without our prefix, with the paths as a person names them.
std::string withoutServing(std::string text);

}  // namespace arete
