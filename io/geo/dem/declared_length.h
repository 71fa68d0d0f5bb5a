// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gdal_priv.h>

#include <string>

#include "engine/base/result.h"
#include "io/geo/gdal/support.h"

namespace arete {

/// Opens a raster as openGdal() does, except that GDAL's own check of raw files, whose message has no
/// numbers, is left to checkDeclaredLength().
GdalDatasetPtr openRasterForLength(const std::string& path);

/// Does for a raster that is open what checkLengthByContent() (io/geo/gdal/file_length.h) does for a file:
/// looks at the files of samples that its bands read (ENVI and other pairs of a header and data, raw bands of
/// virtual rasters, the spill file of an HFA, ILWIS), and at the files that it consists of. Also refuses a
/// virtual raster over a sparse file without NODATA, whose absent blocks it would read as 0.
///
/// Errors: unreadable, unsupported.
Status checkDeclaredLength(GDALDataset& dataset);

}  // namespace arete
