// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ogrsf_frmts.h>

#include <functional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/crs/transform.h"
#include "io/gdal/support.h"
#include "io/table/point_attributes.h"
#include "terrain/model/georeference.h"

namespace arete {

/// What the readers of layers and tables share.

/// Hands the features of a layer over, one after the other. `errors`: collects since before the layer was
/// opened, or since now. Errors: those of `add`, which end it; interrupted; unreadable. O(features).
Status forFeatures(OGRLayer& layer, const GdalErrors& errors, const RunContext& context,
                   const std::function<Status(OGRFeature&)>& add);

PointAttributes::Kind kindOf(OGRFieldType type);

/// The text of a field, all digits of a number; empty where it is not set.
std::string fieldText(OGRFeature& feature, int field);

/// What brings stated coordinates into the DEM's CRS. `own`: the CRS of the file, may be null; `lonLat`: the
/// user says that it is WGS 84; `isTable`: the file is of a kind that never has a CRS. Errors: invalidData (a
/// CRS where the DEM has none), those of CrsTransform.
Result<CrsTransform> transformOf(const OGRSpatialReference* own, const Georeference& dem, bool lonLat,
                                 bool isTable, std::vector<std::string>& warnings);

}  // namespace arete
