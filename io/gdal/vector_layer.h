// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <string>

#include "engine/base/result.h"

namespace arete {

enum class LayerKind {
  points,
  polygons,
  polygonsAndLines,
  linesOrTable,  ///< lines, points, or rows without a geometry
  surfaces,      ///< polygons, TINs and polyhedral surfaces
};

/// The layer of that name, or, for an empty name, the only layer that may hold geometries of that kind.
/// Errors: notFound (no layer of that name), unsupported (no such layer, or several); both list what there
/// is.
Result<OGRLayer*> chooseLayer(GDALDataset& dataset, const std::string& name, LayerKind kind);

}  // namespace arete
