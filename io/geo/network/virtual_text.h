// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/files/byte_source.h"

namespace arete {

/// The text of a virtual raster or layer (VRT) in which each address is a name that is read by checked
/// requests (io/geo/network/served_files.h), and so is each other virtual file that leads to an address. The
/// names of other files that are relative to the VRT become whole ones, so that they are read as ever.
///
/// @param source Any file; its first bytes tell whether it is a VRT.
/// @param path The name under which GDAL reads it.
/// @return Nothing of other files, of a VRT that leads to no address, and where the text cannot be read: GDAL
/// says why. O(text), and as much of each virtual file that it names.
std::optional<std::string> servedVirtualText(const ByteSource& source, const std::string& path);

/// The path for GDAL to open a dataset that a person names: servedPath(), and for a file that
/// servedVirtualText() has another text of, that under our prefix. Reads the first bytes of plain files.
std::string servedDatasetPath(const std::string& path);

}  // namespace arete
