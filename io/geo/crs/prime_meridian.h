// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace arete {

/// Of the prime meridian of a CRS, in degrees east of Greenwich; 0 if the text is empty or not understood.
/// @param crs WKT or any text that GDAL accepts.
double primeMeridianOf(const std::string& crs);

}  // namespace arete
