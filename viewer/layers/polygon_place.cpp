// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each row of the grid is cut by the rings, and the cells between two cuts are in the polygon. The cell that
// is farthest from all cells which are not, or which are not on the terrain, has the place; of several the
// one nearest to the middle of all cells.
#include "viewer/layers/polygon_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "terrain/model/plan_box.h"

namespace arete {
namespace {

constexpr int kSide = 21;           // odd: the middle of a box is the middle of a cell
constexpr int kFramed = kSide + 2;  // with a frame of cells outside
constexpr double kSame = 1e-6;      // distances that differ by less, in cells, are the same

/// Where a row is cut by the rings, ascending.
std::vector<double> cutsOf(std::span<const std::vector<Vec2>> rings, double y) {
  std::vector<double> cuts;
  for (const std::vector<Vec2>& ring : rings)
    for (std::size_t i = 1; i < ring.size(); ++i) {
      const Vec2 a = ring[i - 1], b = ring[i];
      if ((a.y <= y) != (b.y <= y)) cuts.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
  std::ranges::sort(cuts);
  return cuts;
}

}  // namespace

std::optional<Vec2> placeInside(const FeatureLayer& layer, std::span<const FeatureLayer::Line> rings,
                                const GroundHeights& heights) {
  const TerrainModel& model = heights.model();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box2 box{kInfinity, kInfinity, -kInfinity, -kInfinity};
  std::vector<std::vector<Vec2>> inPlan;
  for (const FeatureLayer::Line& ring : rings) {
    std::vector<Vec2>& plan = inPlan.emplace_back();
    for (std::uint64_t i = ring.first; i < ring.first + ring.count; ++i) {
      const Vec2 p = plan.emplace_back(model.toPlan(layer.vertices[i]));
      box = {std::min(box.xMin, p.x), std::min(box.yMin, p.y), std::max(box.xMax, p.x),
             std::max(box.yMax, p.y)};
    }
  }
  const Box2 terrain = planBox(model);
  box = {std::max(box.xMin, terrain.xMin), std::max(box.yMin, terrain.yMin), std::min(box.xMax, terrain.xMax),
         std::min(box.yMax, terrain.yMax)};
  if (!(box.xMax > box.xMin && box.yMax > box.yMin)) return std::nullopt;

  const Vec2 step{(box.xMax - box.xMin) / kSide, (box.yMax - box.yMin) / kSide};
  std::optional<Vec2> narrow;  // in the widest span between two cuts, for a polygon without a cell
  double widest = 0;
  std::array<bool, kFramed * kFramed> isIn{};
  Vec2 sum{0, 0};
  int count = 0;
  for (int row = 1; row <= kSide; ++row) {
    const double y = box.yMin + (row - 0.5) * step.y;
    const std::vector<double> cuts = cutsOf(inPlan, y);
    for (std::size_t i = 0; i + 1 < cuts.size(); i += 2) {
      const double from = std::max(cuts[i], box.xMin), to = std::min(cuts[i + 1], box.xMax);
      const Vec2 middle = model.toSource({(from + to) / 2, y});
      if (to - from > widest && heights.at(middle)) {
        widest = to - from;
        narrow = middle;
      }
      for (int column = 1; column <= kSide; ++column) {
        const double x = box.xMin + (column - 0.5) * step.x;
        if (x < from || x > to || !heights.at(model.toSource({x, y}))) continue;
        isIn[std::size_t(row * kFramed + column)] = true;
        sum = sum + Vec2{double(column), double(row)};
        ++count;
      }
    }
  }
  if (count == 0) return narrow;

  // Distances in units of the shorter side of a cell.
  const double unit = std::min(step.x, step.y);
  const auto distance = [&](double columns, double rows) {
    return std::hypot(columns * step.x, rows * step.y) / unit;
  };
  Vec2 best{0, 0};
  double bestFree = -1, bestOff = 0;
  for (int row = 1; row <= kSide; ++row)
    for (int column = 1; column <= kSide; ++column) {
      if (!isIn[std::size_t(row * kFramed + column)]) continue;
      double free = kInfinity;
      for (int r = 0; r < kFramed; ++r)
        for (int c = 0; c < kFramed; ++c)
          if (!isIn[std::size_t(r * kFramed + c)]) free = std::min(free, distance(c - column, r - row));
      const double off = distance(column - sum.x / count, row - sum.y / count);
      if (free < bestFree - kSame || (free < bestFree + kSame && off >= bestOff)) continue;
      bestFree = free;
      bestOff = off;
      best = {double(column), double(row)};
    }
  return model.toSource({box.xMin + (best.x - 0.5) * step.x, box.yMin + (best.y - 0.5) * step.y});
}

}  // namespace arete
