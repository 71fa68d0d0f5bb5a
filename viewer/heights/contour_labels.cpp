// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lines are met where they cross the rows of the lattice.
#include "viewer/heights/contour_labels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "viewer/heights/finest_lattice.h"

namespace arete {
namespace {

constexpr std::uint32_t kSquare = 32;

/// The place of a square in the order: the first ones have columns and rows that are multiples of a large
/// power of two.
int orderOf(std::uint32_t column, std::uint32_t row) {
  constexpr std::uint32_t kLargest = 1u << 16;
  return 16 - std::min(std::countr_zero(column | kLargest), std::countr_zero(row | kLargest));
}

}  // namespace

Result<std::vector<ContourLabel>> contourLabels(const TerrainModel& model, double interval) {
  HeightLattice lattice;
  if (model.isRaster) {
    lattice = latticeOfSamples(model);
  } else {
    ARETE_TRY(HeightLattice resampled, latticeOfTriangles(model, 0, std::uint64_t(1) << 20));
    lattice = std::move(resampled);
  }
  constexpr double kEvery = 5;
  const double step = interval * kEvery;
  struct Found {
    double offCentre;
    ContourLabel label;
  };
  std::vector<std::pair<int, ContourLabel>> labels;  // by the order of their squares
  for (std::uint32_t top = 0; top < lattice.rows; top += kSquare)
    for (std::uint32_t left = 0; left + 1 < lattice.columns; left += kSquare) {
      std::map<std::int64_t, Found> ofLevel;
      for (std::uint32_t row = top; row < std::min(top + kSquare, lattice.rows); ++row)
        for (std::uint32_t column = left; column < std::min(left + kSquare, lattice.columns - 1); ++column) {
          const double* h = &lattice.heights[std::size_t(row) * lattice.columns + column];
          const double a = h[0] / step, b = h[1] / step;
          if (std::isnan(a) || std::isnan(b)) continue;
          // A level at which ground lies exactly is above it.
          const double low = std::min(a, b), high = std::max(a, b);
          const double level = std::ceil(low);
          if (!(level < high)) continue;
          const double x = column + (level - a) / (b - a);
          const double off = std::hypot(x - left - kSquare / 2.0, row - top - kSquare / 2.0);
          const auto known = ofLevel.find(std::int64_t(level));
          if (known != ofLevel.end() && known->second.offCentre <= off) continue;
          const Vec2 plan{lattice.first.x + x * lattice.step.x, lattice.first.y + row * lattice.step.y};
          ofLevel[std::int64_t(level)] = {off, {model.toSource(plan), level * step}};
        }
      const int order = orderOf(left / kSquare, top / kSquare);
      for (const auto& [level, found] : ofLevel) labels.emplace_back(order, found.label);
    }
  std::ranges::stable_sort(labels, {}, [](const auto& l) { return l.first; });
  std::vector<ContourLabel> places;
  for (const auto& [order, label] : labels) places.push_back(label);
  return places;
}

}  // namespace arete
