// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/laws/model_rows.h"

#include <limits>

namespace arete {

RasterHeightfield samplesInRows(const TerrainModel& model, const ModelRows& rows) {
  RasterHeightfield field;
  field.columns = model.columns;
  field.rows = rows.last - rows.first + 1;
  const std::size_t begin = std::size_t{rows.first} * model.columns,
                    count = std::size_t{field.rows} * model.columns;
  field.heights.assign(count, std::numeric_limits<double>::quiet_NaN());
  const auto put = [&](std::uint32_t sample, double height) {
    if (sample >= begin && sample - begin < count) field.heights[sample - begin] = height;
  };
  for (std::uint32_t v = 0; v < model.mt.vertexCount(); ++v)
    put(model.mt.vertices().samples[v], model.mt.vertices().height(VertexId(v)));
  for (const IsolatedSample& sample : model.isolated) put(sample.sample, sample.height);
  return field;
}

}  // namespace arete
