// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/mt/multitriangulation.h"
#include "terrain/model/build_options.h"
#include "terrain/model/georeference.h"
#include "terrain/model/heightfield.h"
#include "terrain/model/source_reading.h"

namespace arete {

/// A valid sample in no cell with three valid corners: it is stored, and is in no triangle.
struct IsolatedSample {
  std::uint32_t sample = 0;
  double height = 0;
};

/// The result of a build and the content of an .amt file: the multitriangulation of a heightfield, and what
/// is needed to answer in the source's coordinates and units.
struct TerrainModel {
  MultiTriangulation mt;

  Georeference georeference;
  bool isRaster = true;
  std::uint32_t columns = 0, rows = 0;   ///< raster: the source grid; points: 0
  std::vector<IsolatedSample> isolated;  ///< raster only, by rising sample
  std::string source;
  std::string sourceChecksum;
  SourceReading reading = {};  ///< how the source was read

  BuildOptions options;  ///< of the build; fixedVertices are samples of a raster, or MT vertices of points
  std::uint32_t metricP = 1, metricQ = 1;  ///< raster: the Delaunay metric is (p column, q row)
  std::uint32_t levels = 0;

  /// From plan coordinates of the MT to source coordinates: by the geotransform for a raster, unchanged for
  /// points.
  Vec2 toSource(Vec2 plan) const { return isRaster ? georeference.toSource(plan.x, plan.y) : plan; }
  Vec2 toPlan(Vec2 xy) const { return isRaster ? georeference.toGrid(xy.x, xy.y) : xy; }
  /// Whether the map has the opposite orientation of the plan; then exports reverse the triangles.
  bool isFlipped() const { return isRaster && georeference.determinant() < 0; }

  /// The samples that the model was built from, to the bit; NaN for NODATA. O(samples).
  /// @throw std::bad_alloc
  RasterHeightfield rasterSamples() const;
  PointHeightfield pointSamples() const;
};

}  // namespace arete
