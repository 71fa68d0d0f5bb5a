// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "datasets/random.h"
#include "datasets/terrain_generator.h"
#include "terrain/builder/build.h"
#include "terrain/model/camera.h"

namespace arete::test {

/// On a map in metres, north up, far from the origin of its coordinates.
inline TerrainModel modelOf(RasterHeightfield field, double pixelMetres = 30) {
  field.georeference = {};
  field.georeference.geoTransform = {512345.6, pixelMetres, 0, 5234567.8, 0, -pixelMetres};
  field.georeference.hasGeoTransform = true;
  Result<TerrainModel> model = build(field);
  EXPECT_TRUE(model);
  return std::move(*model);
}

inline const TerrainModel& mountains() {
  static const TerrainModel model = [] {
    TerrainOptions options;
    options.columns = 257;
    options.rows = 193;
    options.lake = false;
    Result<RasterHeightfield> field = generateTerrain(options);
    EXPECT_TRUE(field);
    return modelOf(std::move(*field));
  }();
  return model;
}

inline double highest(const TerrainModel& model) {
  double high = -1e300;
  for (std::uint32_t v = 0; v < model.mt.vertexCount(); ++v)
    high = std::max(high, model.mt.vertices().height(VertexId(v)));
  return high;
}

inline Camera anyCamera(Random& random, const TerrainModel& model, int width = 320, int height = 200) {
  const Vec2 plan{random.between(-0.2, 1.2) * model.columns, random.between(-0.2, 1.2) * model.rows};
  return {.xy = model.toSource(plan),
          .height = highest(model) + random.between(5, 1500),
          .azimuthDegrees = random.between(0, 360),
          .pitchDegrees = random.between(-70, 10),
          .verticalFieldOfViewDegrees = random.between(25, 80),
          .widthPixels = double(width),
          .heightPixels = double(height)};
}

}  // namespace arete::test
