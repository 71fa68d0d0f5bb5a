// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gdal_priv.h>

#include <optional>

#include "engine/base/result.h"

namespace arete {

/// What a user states when a file is opened: gdalinfo -oo MAX_ERROR=2 -oo CELL=10 a.amt.
struct DriverOptions {
  double tolerance = 0;        ///< in the unit of heights, or of the surface; 0: the source itself
  std::optional<double> cell;  ///< side of a pixel in the unit of the CRS; none: the grid of the source
};

/// The declaration of the options, as GDAL_DMD_OPENOPTIONLIST.
extern const char* const kAmtOpenOptions;

/// Errors: usage: a number that makes no sense, named.
Result<DriverOptions> readOpenOptions(CSLConstList options);

}  // namespace arete
