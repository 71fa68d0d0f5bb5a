// SPDX-License-Identifier: GPL-3.0-or-later
//
// Groups: every vertex takes the first group that has no neighbour of it yet (a greedy colouring).
#include "terrain/fit/neighbourhoods.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace arete {

std::vector<std::vector<std::uint32_t>> independentVertices(const FitMesh& mesh) {
  std::vector<std::uint32_t> groupOf(mesh.vertexCount(), FitMesh::kNone);
  std::vector<std::vector<std::uint32_t>> groups;
  std::vector<std::uint32_t> takenBy;  // per group: 1 + the last vertex that found a neighbour in it
  for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v) {
    if (!mesh.isIn(v) || mesh.isFixed(v)) continue;
    mesh.forStar(v, [&](std::uint32_t slot) {
      for (const std::uint32_t other : mesh.triangle(slot).corners)
        if (groupOf[other] != FitMesh::kNone) takenBy[groupOf[other]] = v + 1;
    });
    const auto isFree = [&](std::uint32_t by) { return by != v + 1; };
    const auto group = static_cast<std::uint32_t>(std::ranges::find_if(takenBy, isFree) - takenBy.begin());
    if (group == groups.size()) {
      takenBy.push_back(0);
      groups.emplace_back();
    }
    groupOf[v] = group;
    groups[group].push_back(v);
  }
  return groups;
}

FitCells cellsOf(const FitMesh& mesh, std::uint32_t across) {
  FitCells cells{std::vector<std::uint32_t>(mesh.slotCount(), 0),
                 std::vector<std::uint32_t>(mesh.vertexCount(), 0)};
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Vec2 low{kFar, kFar}, high{-kFar, -kFar};
  for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v) {
    const Vec2 p = mesh.plan(mesh.mtVertex(v));
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double side = std::max(high.x - low.x, high.y - low.y);
  const double perCell = across / side;
  // A file may hold any positions.
  if (across <= 1 || !(side > 0) || !std::isfinite(side) || !std::isfinite(perCell)) return cells;
  const auto along = [&](double length) {
    return std::clamp(std::ceil(length * perCell), 1.0, double(across));
  };
  const double columns = along(high.x - low.x), rows = along(high.y - low.y);
  cells.count = static_cast<std::uint32_t>(columns * rows);
  const auto cellAt = [&](Vec2 p) {
    const double column = std::clamp(std::floor((p.x - low.x) * perCell), 0.0, columns - 1),
                 row = std::clamp(std::floor((p.y - low.y) * perCell), 0.0, rows - 1);
    return static_cast<std::uint32_t>(row * columns + column);
  };
  for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v)
    cells.ofVertex[v] = cellAt(mesh.plan(mesh.mtVertex(v)));
  for (std::uint32_t t = 0; t < mesh.slotCount(); ++t) {
    if (!mesh.isLive(t)) continue;
    Vec2 sum{};
    for (const std::uint32_t v : mesh.triangle(t).corners) {
      const Vec2 p = mesh.plan(mesh.mtVertex(v));
      sum = {sum.x + p.x / 3, sum.y + p.y / 3};
    }
    cells.ofSlot[t] = cellAt(sum);
  }
  return cells;
}

}  // namespace arete
