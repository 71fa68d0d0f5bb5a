// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ogrsf_frmts.h>

#include <functional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "io/geo/crs/transform.h"
#include "io/geo/gdal/support.h"
#include "io/geo/text/point_attributes.h"
#include "terrain/model/georeference.h"

namespace arete {

/// Calls `add` for each feature of a layer, in the order of the layer. Stops at the first error.
///
/// @param dataset That of the layer.
/// @param errors The messages of GDAL while it reads.
///
/// Errors: those of `add`. unreadable: GDAL reports a failure. corrupt: those of checkFeatureCount().
/// interrupted. O(features).
Status forFeatures(GDALDataset& dataset, OGRLayer& layer, const GdalErrors& errors, const RunContext& context,
                   const std::function<Status(OGRFeature&)>& add);

/// @return The kind of column that holds the values of a field; text for lists.
PointAttributes::Kind kindOf(const OGRFieldDefn& field);

/// @return The text of a field, with the shortest digits that give the same double (or float, if the field
/// holds floats), dates and times in ISO 8601; empty if it is not set.
std::string fieldText(OGRFeature& feature, int field);

/// Makes the transformation from the coordinates of a file to the DEM's CRS.
///
/// @param own The CRS of the file; may be null.
/// @param lonLat Coordinates without a CRS are longitude and latitude of WGS 84.
/// @param isTable The format has no CRS, so that its absence is not worth a warning.
///
/// Errors: invalidData: the file has a CRS and the DEM has none. Also those of CrsTransform.
Result<CrsTransform> transformOf(const OGRSpatialReference* own, const Georeference& dem, bool lonLat,
                                 bool isTable, Warnings& warnings);

}  // namespace arete
