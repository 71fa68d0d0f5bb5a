// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <string>

#include "engine/base/result.h"

namespace arete {

/// The kind of geometries that a reader needs.
enum class LayerKind {
  points,
  polygons,
  polygonsAndLines,
  shapes,        ///< polygons and lines, or else points
  linesOrTable,  ///< lines, points, or rows without a geometry
  surfaces,      ///< polygons, TINs and polyhedral surfaces
  any,           ///< whatever has a geometry; of a GPX file not the points that its lines repeat
};

/// Finds a layer by name or, for an empty name, the only layer that may hold geometries of that kind, or else
/// the only one of them that is not empty.
///
/// @return Owned by the dataset.
///
/// Errors: notFound: no layer of that name. unsupported: no layer of that kind, or several. Both list the
/// layers.
Result<OGRLayer*> chooseLayer(GDALDataset& dataset, const std::string& name, LayerKind kind);

}  // namespace arete
