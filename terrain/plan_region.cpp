// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/plan_region.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace arete {
namespace {

using Rings = std::vector<std::vector<Vec2>>;

template <class ToPlan>
Region mapped(Rings rings, const ToPlan& toPlan) {
  for (std::vector<Vec2>& ring : rings)
    for (Vec2& p : ring) p = toPlan(p);
  return Region(std::move(rings));
}

}  // namespace

Region planRegion(Rings sourceRings, const TerrainModel& model) {
  return mapped(std::move(sourceRings), [&](Vec2 p) { return model.toPlan(p); });
}

Region planRegion(Rings sourceRings, const RasterHeightfield& heightfield) {
  return mapped(std::move(sourceRings), [&](Vec2 p) { return heightfield.georeference.toGrid(p.x, p.y); });
}

Region planRegion(Rings sourceRings, const PointHeightfield&) {
  return Region(std::move(sourceRings));
}

bool meetsDomain(const Region& region, const MultiTriangulation& mt) {
  const VertexArrays& v = mt.vertices();
  return std::ranges::any_of(mt.arrays().rootTriangles, [&](const auto& c) {
    return region.meetsTriangle(v.planPosition(VertexId(c[0])), v.planPosition(VertexId(c[1])),
                                v.planPosition(VertexId(c[2])));
  });
}

std::vector<std::uint8_t> samplesInside(const Region& region, const RasterHeightfield& heightfield) {
  std::vector<std::uint8_t> inside(heightfield.size(), 0);
  const Box2 bounds = region.bounds();
  for (std::uint32_t row = 0; row < heightfield.rows; ++row) {
    if (row < bounds.yMin || row > bounds.yMax) continue;
    for (std::uint32_t column = 0; column < heightfield.columns; ++column) {
      if (column < bounds.xMin || column > bounds.xMax) continue;
      inside[heightfield.index(column, row)] =
          region.contains({static_cast<double>(column), static_cast<double>(row)}) ? 1 : 0;
    }
  }
  return inside;
}

std::vector<std::uint8_t> samplesInside(const Region& region, const PointHeightfield& heightfield) {
  std::vector<std::uint8_t> inside(heightfield.size(), 0);
  for (std::size_t i = 0; i < inside.size(); ++i)
    inside[i] = region.contains(heightfield.positions[i]) ? 1 : 0;
  return inside;
}

}  // namespace arete
