// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/base/vec.h"
#include "engine/parallel/run_context.h"
#include "terrain/measure/measure.h"
#include "terrain/model/heightfield.h"

namespace arete {

/// The part of a pixel beyond the rim up to which a sample counts as covered.
inline constexpr double kBeyondRimPixels = 0.1;

/// Where a TIN is, as its file says.
struct TinPlace {
  std::string crsWkt = {};               ///< MeshFile::crsWkt
  std::optional<Vec3> metresAbout = {};  ///< MeshFile::metresAbout
};

/// Whether a TIN is elsewhere than the DEM's coordinates: in metres, or in a CRS that is known to be another.
bool isElsewhere(const TinPlace& place, const Georeference& dem);

/// measure() (terrain/measure/measure.h) of a TIN that is elsewhere. Each sample is led to where the TIN has
/// it, and the TIN's height there is compared: in another CRS above the sample's place on that map; in metres
/// along the ellipsoid's normal through the sample. Nothing of the TIN is moved, and nothing that led it
/// there is used. A sample beyond the rim by at most a tenth of a pixel has the height of the rim next to it,
/// because the rim's edges are straight in the TIN's plan and not in the DEM's.
///
/// Errors and positions in the report are in the DEM's units. Areas are in square pixels of the mean spacing.
/// NODATA counts as covered within a triangle and on its edges.
///
/// Errors: as measure(); invalidData, usage: no transformation leads there. O(n log n).
Result<MeasureReport> measureElsewhere(const TriangleMesh& mesh, const TinPlace& place,
                                       const RasterHeightfield& dem, const MeasureOptions& options = {},
                                       const RunContext& context = {}, MeasureRasters* rasters = nullptr);
Result<MeasureReport> measureElsewhere(const TriangleMesh& mesh, const TinPlace& place,
                                       const PointHeightfield& points, const MeasureOptions& options = {},
                                       const RunContext& context = {}, MeasureRasters* rasters = nullptr);

}  // namespace arete
