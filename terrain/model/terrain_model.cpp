// SPDX-License-Identifier: GPL-3.0-or-later
//
// The samples are read back from the vertices of the multitriangulation, which have exact heights.
#include "terrain/model/terrain_model.h"

#include <limits>

#include "engine/memory/required_memory.h"

namespace arete {

RasterHeightfield TerrainModel::rasterSamples() const {
  RasterHeightfield field;
  field.columns = columns;
  field.rows = rows;
  field.georeference = georeference;
  field.source = source;
  field.sourceChecksum = sourceChecksum;
  field.rawScale = mt.vertices().encoding.scale;
  field.rawOffset = mt.vertices().encoding.offset;
  requireMemory(std::uint64_t(columns) * rows * sizeof(double), "take a part of the terrain");
  field.heights.assign(std::size_t(columns) * rows, std::numeric_limits<double>::quiet_NaN());
  for (std::uint32_t v = 0; v < mt.vertexCount(); ++v)
    field.heights[mt.vertices().samples[v]] = mt.vertices().height(VertexId(v));
  for (const IsolatedSample& sample : isolated) field.heights[sample.sample] = sample.height;
  return field;
}

PointHeightfield TerrainModel::pointSamples() const {
  PointHeightfield field;
  field.georeference = georeference;
  field.source = source;
  field.sourceChecksum = sourceChecksum;
  field.positions.reserve(mt.vertexCount());
  field.heights.reserve(mt.vertexCount());
  for (std::uint32_t v = 0; v < mt.vertexCount(); ++v) {
    field.positions.push_back(mt.vertices().planPosition(VertexId(v)));
    field.heights.push_back(mt.vertices().height(VertexId(v)));
  }
  return field;
}

}  // namespace arete
