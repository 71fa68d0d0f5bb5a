// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace arete {

/// A CRS in a few words: "WGS 84 / UTM zone 11N (EPSG:32611)"; "none" for an empty text; "unknown" for one
/// that GDAL does not understand. `crs`: WKT or any text GDAL takes.
std::string crsName(const std::string& crs);

/// Whether its x and y are longitude and latitude; false where it is empty or not understood.
bool isGeographicCrs(const std::string& crs);

enum class CrsAgreement {
  same,
  different,
  unknown,  ///< one of the two is empty or not understood
};

/// Whether two CRSs place x, y alike; vertical parts and the order of the axes do not count.
CrsAgreement compareCrs(const std::string& a, const std::string& b);

}  // namespace arete
