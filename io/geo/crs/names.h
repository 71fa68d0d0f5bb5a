// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace arete {

/// The name of a CRS for people: "WGS 84 / UTM zone 11N (EPSG:32611)".
///
/// @param crs WKT or any text that GDAL accepts.
/// @return "none" for an empty text, "unknown" if GDAL does not understand it.
std::string crsName(const std::string& crs);

/// @return True if x and y of the CRS are longitude and latitude. False if it is empty or not understood.
bool isGeographicCrs(const std::string& crs);

enum class CrsAgreement {
  same,
  different,
  unknown,  ///< at least one is empty or not understood
};

/// Compares the horizontal parts of two CRSs, whatever the order of their axes.
CrsAgreement compareCrs(const std::string& a, const std::string& b);

}  // namespace arete
