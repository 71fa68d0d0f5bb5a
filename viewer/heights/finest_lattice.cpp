// SPDX-License-Identifier: GPL-3.0-or-later
//
// A raster's triangles are compared with what RasterCells makes of its samples: one that is not in a cell, or
// lies across the other diagonal, or a count that differs, and the samples alone do not say what is between
// them.
#include "viewer/heights/finest_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/memory/required_memory.h"
#include "engine/mt/multitriangulation.h"
#include "terrain/model/raster_cells.h"

namespace arete {
namespace {

/// Calls visit(corners) for each triangle that no node removes.
template <class Visit>
void forFinestTriangles(const MultiTriangulation& mt, const Visit& visit) {
  for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t)
    if (!mt.remover(TriangleId(t)).isValid()) visit(mt.rootTriangles()[t]);
  for (std::uint32_t n = 0; n < mt.nodeCount(); ++n)
    for (std::uint32_t slot = 0; slot < mt.ceilingSize(NodeId(n)); ++slot) {
      const TriangleId t = mt.slotTriangle(NodeId(n), slot);
      if (!mt.remover(t).isValid()) visit(mt.corners(t, NodeId(n)));
    }
}

bool isOfCells(const TerrainModel& model, const RasterHeightfield& field) {
  const RasterCells cells(field);
  std::uint64_t found = 0, expected = 0;
  bool areInCells = true;
  const auto& samples = model.mt.vertices().samples;
  forFinestTriangles(model.mt, [&](const std::array<std::uint32_t, 3>& corners) {
    ++found;
    std::uint32_t left = ~0u, right = 0, top = ~0u, bottom = 0;
    for (const std::uint32_t v : corners) {
      const std::uint32_t column = samples[v] % field.columns, row = samples[v] / field.columns;
      left = std::min(left, column), right = std::max(right, column);
      top = std::min(top, row), bottom = std::max(bottom, row);
    }
    if (right - left != 1 || bottom - top != 1) {
      areInCells = false;
      return;
    }
    unsigned mine = 0;
    for (const std::uint32_t v : corners)
      mine |= 1u << (samples[v] % field.columns - left + 2 * (samples[v] / field.columns - top));
    constexpr unsigned kMain = RasterCells::upperLeft | RasterCells::lowerRight;
    if (cells.valid(left, top) == RasterCells::all && (mine & kMain) != kMain) areInCells = false;
  });
  if (!areInCells) return false;
  for (std::uint32_t row = 0; row + 1 < field.rows; ++row)
    for (std::uint32_t column = 0; column + 1 < field.columns; ++column)
      expected += RasterCells::triangleCount(cells.valid(column, row));
  return found == expected;
}

/// Nodes without data beside nodes with data get what the two before them continue to.
void extendByOne(HeightLattice& lattice) {
  const std::vector<double> inside = lattice.heights;
  const auto at = [&](std::int64_t column, std::int64_t row) {
    if (column < 0 || row < 0 || column >= lattice.columns || row >= lattice.rows)
      return std::numeric_limits<double>::quiet_NaN();
    return inside[std::size_t(row) * lattice.columns + std::size_t(column)];
  };
  for (std::int64_t row = 0; row < lattice.rows; ++row)
    for (std::int64_t column = 0; column < lattice.columns; ++column) {
      if (!std::isnan(at(column, row))) continue;
      double sum = 0, weight = 0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const double near = at(column + dx, row + dy), far = at(column + 2 * dx, row + 2 * dy);
          if (std::isnan(near)) continue;
          sum += std::isnan(far) ? near : 2 * near - far;
          ++weight;
        }
      if (weight > 0)
        lattice.heights[std::size_t(row) * lattice.columns + std::size_t(column)] = sum / weight;
    }
}

}  // namespace

HeightLattice latticeOfSamples(const TerrainModel& model) {
  RasterHeightfield field = model.rasterSamples();
  for (const IsolatedSample& sample : model.isolated)
    field.heights[sample.sample] = std::numeric_limits<double>::quiet_NaN();
  HeightLattice lattice{.columns = field.columns, .rows = field.rows, .first = {0, 0}, .step = {1, 1}};
  lattice.isExact = isOfCells(model, field);
  lattice.heights = std::move(field.heights);
  return lattice;
}

Result<HeightLattice> latticeOfTriangles(const TerrainModel& model, double step, std::uint64_t most) {
  const MultiTriangulation& mt = model.mt;
  const Vec3& scale = mt.metric().scale;
  Box2 box{INFINITY, INFINITY, -INFINITY, -INFINITY};
  double area = 0;  // metric
  forFinestTriangles(mt, [&](const std::array<std::uint32_t, 3>& corners) {
    std::array<Vec2, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = mt.vertices().planPosition(VertexId(corners[i]));
      box.xMin = std::min(box.xMin, p[i].x), box.xMax = std::max(box.xMax, p[i].x);
      box.yMin = std::min(box.yMin, p[i].y), box.yMax = std::max(box.yMax, p[i].y);
    }
    area += std::abs((p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x)) / 2 *
            std::abs(scale.x * scale.y);
  });
  if (!(area > 0)) return failure(ErrorCode::invalidData, "the model has no triangle", model.source);
  const double width = (box.xMax - box.xMin) * std::abs(scale.x),
               height = (box.yMax - box.yMin) * std::abs(scale.y);
  constexpr double kPerSpacing = 4;
  if (!(step > 0)) step = std::sqrt(area / mt.vertexCount()) / kPerSpacing;
  // Two nodes more each way than the box: half a step around it.
  const auto nodes = [](double length, double by) { return std::ceil(length / by) + 3; };
  while (nodes(width, step) * nodes(height, step) > double(most)) step *= 1.02;

  HeightLattice lattice;
  lattice.step = {step / std::abs(scale.x), step / std::abs(scale.y)};
  lattice.first = {box.xMin - lattice.step.x, box.yMin - lattice.step.y};
  lattice.columns = std::uint32_t(nodes(width, step));
  lattice.rows = std::uint32_t(nodes(height, step));
  requireMemory(std::uint64_t(lattice.columns) * lattice.rows * sizeof(double));
  lattice.heights.assign(std::size_t(lattice.columns) * lattice.rows,
                         std::numeric_limits<double>::quiet_NaN());
  forFinestTriangles(mt, [&](const std::array<std::uint32_t, 3>& corners) {
    std::array<Vec2, 3> p;
    std::array<double, 3> z;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 q = mt.vertices().planPosition(VertexId(corners[i]));
      p[i] = {(q.x - lattice.first.x) / lattice.step.x, (q.y - lattice.first.y) / lattice.step.y};
      z[i] = mt.vertices().height(VertexId(corners[i]));
    }
    const double twice = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    if (twice == 0) return;
    constexpr double kSlack = 1e-9;  // of a step, so that no node on an edge is missed
    const auto from = [](double v) { return std::uint32_t(std::max(0.0, std::ceil(v - kSlack))); };
    for (std::uint32_t row = from(std::min({p[0].y, p[1].y, p[2].y}));
         row < lattice.rows && row <= std::max({p[0].y, p[1].y, p[2].y}) + kSlack; ++row)
      for (std::uint32_t column = from(std::min({p[0].x, p[1].x, p[2].x}));
           column < lattice.columns && column <= std::max({p[0].x, p[1].x, p[2].x}) + kSlack; ++column) {
        const auto part = [&](std::size_t a, std::size_t b) {
          return ((p[b].x - p[a].x) * (row - p[a].y) - (p[b].y - p[a].y) * (column - p[a].x)) / twice;
        };
        const double u = part(1, 2), v = part(2, 0), w = 1 - u - v;
        if (u < -kSlack || v < -kSlack || w < -kSlack) continue;
        lattice.heights[std::size_t(row) * lattice.columns + column] = u * z[0] + v * z[1] + w * z[2];
      }
  });
  extendByOne(lattice);
  return lattice;
}

}  // namespace arete
