// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ogr_spatialref.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "terrain/model/georeference.h"

namespace arete {

/// Parses a CRS that comes from a file: WKT, PROJJSON, a PROJ string, a code ("EPSG:32611",
/// "EPSG:4326+5773"). The name of a file or an address is an error, also within a PROJ string or as a
/// parameter (fileNamedBy()), so that data cannot make the program open anything.
///
/// Errors: invalidData, without a culprit: not a CRS, a vertical CRS alone, or one that names a file.
Result<OGRSpatialReference> crsFromText(const std::string& text);

/// Parses a CRS that comes from a person: as crsFromText(), and also a .prj file or an address, and with
/// grids of any path.
///
/// Errors: usage, with the text as culprit: not a CRS, or a vertical CRS alone.
Result<OGRSpatialReference> crsFromUser(const std::string& text);

/// @return True if a layer has a CRS. A layer of a GeoPackage without one has "Undefined ... SRS".
bool isKnownCrs(const OGRSpatialReference* crs);

/// @return WKT 2; empty if the CRS cannot be expressed in it.
std::string wktOf(const OGRSpatialReference& crs);

/// Chooses between the CRS of a file and the one a person states, which takes precedence, with a warning if
/// the two differ.
///
/// @param own The CRS of the file; may be null.
/// @param text Stated by a person; empty: none.
/// @return An empty CRS if there is no CRS. Errors: those of crsFromUser().
Result<OGRSpatialReference> chooseCrs(const OGRSpatialReference* own, const std::string& text,
                                      Warnings& warnings);

/// Fills the CRS part of a georeference: WKT 2, kind, units, ellipsoid and, from a compound or
/// three-dimensional CRS, the vertical unit and datum. An empty CRS changes nothing.
///
/// Errors: unsupported: a geocentric CRS.
Status describeCrs(const OGRSpatialReference& crs, Georeference& georeference);

/// @param name A usual name of a unit of length, in either case: "m", "metre", "ft", "US survey foot", ...
/// @return Metres per unit; nothing for an unknown name.
std::optional<double> metresPerUnit(std::string_view name);

}  // namespace arete
