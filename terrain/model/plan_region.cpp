// SPDX-License-Identifier: GPL-3.0-or-later
//
// The vertices of the region are transformed to plan coordinates; the metric for distances is that of the
// model, or that of the middle of the heightfield.
#include "terrain/model/plan_region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "terrain/model/georeference.h"

namespace arete {
namespace {

template <class ToPlan>
Region mapped(RegionShape shape, const MetricFrame& metric, const ToPlan& toPlan) {
  for (auto* chains : {&shape.rings, &shape.lines})
    for (std::vector<Vec2>& chain : *chains)
      for (Vec2& p : chain) p = toPlan(p);
  return Region(std::move(shape), metric);
}

MetricFrame metricAt(const Georeference& georeference, Vec2 grid) {
  MetricFrame metric;
  const Vec2 step = groundStep(georeference, grid.x, grid.y);
  metric.scale = {step.x, step.y, georeference.verticalUnitMetres};
  return metric;
}

}  // namespace

Region planRegion(RegionShape sourceShape, const TerrainModel& model) {
  return mapped(std::move(sourceShape), model.mt.metric(), [&](Vec2 p) { return model.toPlan(p); });
}

Region planRegion(RegionShape sourceShape, const RasterHeightfield& heightfield) {
  const MetricFrame metric =
      metricAt(heightfield.georeference, {(heightfield.columns - 1) / 2.0, (heightfield.rows - 1) / 2.0});
  return mapped(std::move(sourceShape), metric,
                [&](Vec2 p) { return heightfield.georeference.toGrid(p.x, p.y); });
}

Region planRegion(RegionShape sourceShape, const PointHeightfield& heightfield) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec2 low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  for (const Vec2 p : heightfield.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const Vec2 grid = heightfield.georeference.toGrid((low.x + high.x) / 2, (low.y + high.y) / 2);
  return mapped(std::move(sourceShape), metricAt(heightfield.georeference, grid), [](Vec2 p) { return p; });
}

bool meetsDomain(const Region& region, const MultiTriangulation& mt) {
  const VertexArrays& v = mt.vertices();
  return std::ranges::any_of(mt.rootTriangles(), [&](const auto& c) {
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
