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

/// A valid sample in no cell with three valid corners: kept, in no triangle.
struct IsolatedSample {
  std::uint32_t sample = 0;
  double height = 0;
};

/// What a build makes of a heightfield and what an .amt file holds: the multitriangulation and all that is
/// needed to give its answers in the source's own terms.
struct TerrainModel {
  MultiTriangulation mt;

  Georeference georeference;
  bool isRaster = true;
  std::uint32_t columns = 0, rows = 0;   ///< raster: the source grid; points: 0
  std::vector<IsolatedSample> isolated;  ///< raster only, by rising sample
  std::string source;
  std::string sourceChecksum;
  SourceReading reading = {};  ///< how the source was read

  BuildOptions options;  ///< as built; fixedVertices are samples of a raster, MT vertices of points
  std::uint32_t metricP = 1, metricQ = 1;  ///< raster: the Delaunay metric is (p column, q row)
  std::uint32_t levels = 0;

  /// Plan coordinates of the MT to source coordinates: by the geotransform for a raster, themselves for
  /// points.
  Vec2 toSource(Vec2 plan) const { return isRaster ? georeference.toSource(plan.x, plan.y) : plan; }
  Vec2 toPlan(Vec2 xy) const { return isRaster ? georeference.toGrid(xy.x, xy.y) : xy; }
  /// The map turns the other way round than the plan coordinates: triangles are flipped on the way out.
  bool isFlipped() const { return isRaster && georeference.determinant() < 0; }

  /// The source's samples, NaN where there are none: what the model was built from, to the bit. O(samples).
  RasterHeightfield rasterSamples() const;
  PointHeightfield pointSamples() const;
};

}  // namespace arete
