// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"

namespace arete {

/// Looks for the end of a file whose records GDAL reads as far as they go: what was cut off in the middle of
/// one is no error there. Every record of a GeoJSON text sequence (of lines, or behind record separators
/// of RFC 8142) must be one JSON object, by its brackets and quotation marks; a quoted text of a CSV must
/// end; the last line of an OGR GMT, Geoconcept, VDV or Interlis 1 file should end with a line break, or a
/// warning says so. Files of other formats pass.
///
/// @param driver GDAL's short name of the format.
///
/// Errors: corrupt, with the number of the record and its line. O(file size) for the formats above.
Status checkWholeText(const std::string& path, std::string_view driver, Warnings& warnings);

}  // namespace arete
