// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "terrain/model/heightfield.h"

namespace arete {

/// Dams a valley with a moraine and makes the lake behind it NODATA: one connected void of about half a
/// percent of the map, clear of its border where a valley allows. Precondition: no NODATA yet, columns and
/// rows >= 16. O(n log n).
void floodLake(RasterHeightfield& field, double pixelMetres);

}  // namespace arete
