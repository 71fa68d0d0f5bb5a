// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"

namespace arete {

/// @return True if the name of a DEM stands for several files: a folder that GDAL does not read as one
/// raster, or a pattern with *, ? or [ for which there is no file.
bool namesSeveralFiles(const std::string& name);

/// Replaces folders by the rasters in them and patterns by the files that match, each sorted by name. Files
/// that belong to another one (overviews, masks, headers) are left out of a folder, as are files that are no
/// rasters. No file occurs twice.
///
/// Errors: notFound: a pattern without a file. unsupported: a folder without a raster.
Result<std::vector<std::string>> demFilesOf(const std::vector<std::string>& names);

}  // namespace arete
