// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace arete {

/// GDAL's way to our ByteSource: files whose names begin with a prefix of our own, "/vsiarete/".
///
///     /vsiarete/https://host/a.tif      the file of an address, by checked requests (io/files/network)
///     /vsiarete?OPTIONS&url=ADDRESS     the same, with the options of GDAL's "/vsicurl?"
///     /vsiarete/PATH                    another file of GDAL, as it is
///
/// Where such a file is a virtual raster or layer (VRT) that names addresses, itself or through another one,
/// its text is given with these names under the prefix (io/geo/network/virtual_text.h), so that its sources
/// are read by checked requests too. GDAL's own "/vsicurl/" is not touched.
///
/// Installs the files on the first call, which is best made before other threads use GDAL: GDAL's list of
/// file systems is not guarded. Several libraries in a process may each have a copy of this code, with
/// threads and readings of its own: the second one's prefix is "/vsiarete2".
///
/// @return The prefix without what ends it; empty where GDAL reads nothing over the network, or may not.
const std::string& servedName();

/// No file is installed from now on, and servedName() is empty. What was installed stays.
void forbidServedFiles();

}  // namespace arete
