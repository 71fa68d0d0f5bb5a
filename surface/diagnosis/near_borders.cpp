// SPDX-License-Identifier: GPL-3.0-or-later
//
// Space is divided into cells twice as wide as the distance, so that what is near an end is in its cell or in
// seven others. Edges are grouped by the cells of their ends. An edge is held against few of a group: where
// many are near each other, the first ones are.
#include <cmath>
#include <tuple>
#include <unordered_map>

#include "surface/diagnosis/parts.h"

namespace arete::diagnosis {
namespace {

constexpr std::size_t kMostCompared = 64;
constexpr double kLargestShare = 0.1;  // of the length of an edge

using Cell = std::array<double, 3>;
using Edge = std::array<std::uint32_t, 2>;

struct Hash {
  std::size_t operator()(const std::array<Cell, 2>& cells) const {
    std::size_t hash = 0;
    for (const Cell& cell : cells)
      for (const double c : cell) hash = hash * 0x9E3779B97F4A7C15ull + std::hash<double>()(c);
    return hash;
  }
};

double cellOf(double coordinate, double width) {
  return std::floor(coordinate / width) + 0.0;
}

/// The cells that a ball of a quarter of their width about a point may meet.
std::vector<Cell> cellsAround(const Vec3& p, double width) {
  std::vector<Cell> cells;
  const auto both = [&](double c) {
    return std::array{cellOf(c - width / 2, width), cellOf(c + width / 2, width)};
  };
  for (const double x : both(p.x))
    for (const double y : both(p.y))
      for (const double z : both(p.z)) cells.push_back({x, y, z});
  return cells;
}

}  // namespace

std::vector<NearBorder> findNearBorders(std::span<const Vec3> positions, std::span<const Edge> edges,
                                        double distance) {
  std::vector<NearBorder> found;
  if (!(distance > 0)) return found;
  const double width = 2 * distance;
  const auto cell = [&](std::uint32_t v) {
    const Vec3& p = positions[v];
    return Cell{cellOf(p.x, width), cellOf(p.y, width), cellOf(p.z, width)};
  };
  std::unordered_map<std::array<Cell, 2>, std::vector<Edge>, Hash> groups;
  for (const auto& [a, b] : edges) {
    groups[{cell(a), cell(b)}].push_back({a, b});
    groups[{cell(b), cell(a)}].push_back({b, a});
  }
  for (const Edge& edge : edges) {
    const Vec3 &p = positions[edge[0]], &q = positions[edge[1]];
    const double length = norm(q - p);
    double nearest = -1;
    for (const Cell& first : cellsAround(p, width))
      for (const Cell& second : cellsAround(q, width)) {
        const auto group = groups.find({first, second});
        if (group == groups.end()) continue;
        std::size_t compared = 0;
        for (const Edge& other : group->second) {
          if (++compared > kMostCompared) break;
          // Itself, and edges that follow it.
          if (other == edge || other[0] == edge[1] || other[1] == edge[0]) continue;
          const Vec3 &u = positions[other[0]], &w = positions[other[1]];
          if (u == p && w == q) continue;
          const double apart = std::max(norm(u - p), norm(w - q));
          if (apart > distance || apart > kLargestShare * std::min(length, norm(w - u))) continue;
          if (nearest < 0 || apart < nearest) nearest = apart;
        }
      }
    if (nearest >= 0) found.push_back({edge, nearest});
  }
  return found;
}

}  // namespace arete::diagnosis
