// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace arete {

/// From now on PROJ opens only the files that projMayOpen() allows, for GDAL too: what stands in a file
/// cannot make the program read other files, or wait for a pipe. Call it once, before GDAL is used.
void guardProjFiles();

}  // namespace arete
