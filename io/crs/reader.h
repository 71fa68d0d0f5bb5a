// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ogr_spatialref.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "terrain/model/georeference.h"

namespace arete {

/// The CRS of a text that stands in a file: WKT, PROJJSON, a PROJ string, a code ("EPSG:32611",
/// "EPSG:4326+5773"). A text that names a file or an address is none: what a file says opens nothing. Errors:
/// usage, naming the text; a vertical CRS alone is one too.
Result<OGRSpatialReference> crsFromText(const std::string& text);

/// The CRS a person names: all of that, a .prj file and an address.
Result<OGRSpatialReference> crsFromUser(const std::string& text);

/// Whether a layer has a CRS: a GeoPackage says "Undefined ... SRS" where it has none.
bool isKnownCrs(const OGRSpatialReference* crs);

/// WKT 2 of a CRS; empty for one that has none.
std::string wktOf(const OGRSpatialReference& crs);

/// The CRS to use: the one a person stated where `text` names one (with a warning where it replaces another),
/// else the file's own, which may be null. An empty CRS = none.
Result<OGRSpatialReference> chooseCrs(const OGRSpatialReference* own, const std::string& text,
                                      std::vector<std::string>& warnings);

/// Fills the CRS part of a georeference: WKT 2, kind, units, ellipsoid, and from a compound or
/// three-dimensional CRS the vertical unit and datum. An empty CRS leaves everything as it is. Errors:
/// unsupported (geocentric).
Status describeCrs(const OGRSpatialReference& crs, Georeference& georeference);

/// Metres in a unit of height by one of its usual names ("m", "metre", "ft", "US survey foot", ...); upper
/// and lower case alike. Nothing for a name that is not known.
std::optional<double> metresPerUnit(std::string_view name);

}  // namespace arete
