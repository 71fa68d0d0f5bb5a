// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/model/relief.h"

#include <cmath>
#include <limits>

namespace arete {
namespace {

struct HeightRange {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;

  void add(double height) {
    if (height < lowest) lowest = height;
    if (height > highest) highest = height;
  }
  double size() const { return highest >= lowest ? highest - lowest : 0; }
};

}  // namespace

double reliefOf(std::span<const double> heights) {
  HeightRange range;
  for (const double height : heights) range.add(height);
  return range.size();
}

double reliefOf(const TerrainModel& model) {
  HeightRange range;
  for (std::uint32_t v = 0; v < model.mt.vertexCount(); ++v) range.add(model.mt.position(VertexId(v)).z);
  for (const IsolatedSample& sample : model.isolated) range.add(sample.height);
  return range.size();
}

}  // namespace arete
