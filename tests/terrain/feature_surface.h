// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small surfaces for tests of features, and an oracle that floods them afresh at every threshold.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "terrain/features/features.h"
#include "terrain/grid_triangles.h"

namespace arete::features_test {

using testing::gridHeights;
using testing::gridTriangles;
using Kind = Feature::Kind;

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct Surface {
  std::uint32_t columns = 0, rows = 0;
  std::vector<double> heights;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  Surface(std::uint32_t columnCount, std::uint32_t rowCount, std::vector<double> z)
      : columns(columnCount), rows(rowCount), heights(std::move(z)) {
    triangles = gridTriangles(columns, rows, heights);
  }
  Surface(std::uint32_t columnCount, std::uint32_t rowCount,
          const std::function<double(double, double)>& height)
      : Surface(columnCount, rowCount, gridHeights(columnCount, rowCount, height)) {}

  std::uint32_t at(std::uint32_t column, std::uint32_t row) const { return row * columns + column; }
  std::vector<Feature> rank(const FeatureOptions& options = {}, const RunContext& context = {}) const {
    return rankFeatures(heights, triangles, options, context);
  }
  std::vector<Feature> rankAsRaster(const RunContext& context = {}) const {
    RasterHeightfield field;
    field.columns = columns;
    field.rows = rows;
    field.heights = heights;
    return rankFeatures(field, {}, context);
  }
  std::vector<std::set<std::uint32_t>> neighbours() const {
    std::vector<std::set<std::uint32_t>> result(heights.size());
    for (const auto& t : triangles) {
      for (int i = 0; i < 3; ++i) {
        result[t[i]].insert(t[(i + 1) % 3]);
        result[t[(i + 1) % 3]].insert(t[i]);
      }
    }
    return result;
  }
};

inline std::size_t count(const std::vector<Feature>& features, Kind kind) {
  return std::size_t(
      std::count_if(features.begin(), features.end(), [&](const Feature& f) { return f.kind == kind; }));
}

inline Feature feature(const Surface& s, Kind kind, std::uint32_t sample, double persistence) {
  return {kind, sample, s.heights[sample], persistence};
}

// The oracle: components found afresh at every threshold by flooding. An extremum lives while it is its
// component's most extreme vertex; the first threshold at which it is not names the pass.
inline std::vector<Feature> rankByFlooding(const Surface& s) {
  const auto neighbours = s.neighbours();
  std::vector<Feature> found;
  std::map<std::uint32_t, std::uint32_t> lowestOf, highestOf;
  for (const double sign : {1.0, -1.0}) {
    std::vector<std::uint32_t> order;
    for (std::uint32_t v = 0; v < s.heights.size(); ++v) {
      if (!std::isnan(s.heights[v])) order.push_back(v);
    }
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(sign * s.heights[a], sign * a) < std::pair(sign * s.heights[b], sign * b);
    });
    std::vector<std::size_t> position(s.heights.size(), order.size());
    for (std::size_t i = 0; i < order.size(); ++i) position[order[i]] = i;
    std::set<std::uint32_t> alive;
    std::vector<std::uint32_t> leader(s.heights.size());
    for (std::size_t threshold = 0; threshold < order.size(); ++threshold) {
      std::vector<bool> reached(s.heights.size(), false);
      std::set<std::uint32_t> leaders;
      for (std::size_t i = 0; i <= threshold; ++i) {
        if (reached[order[i]]) continue;
        leaders.insert(order[i]);
        std::vector<std::uint32_t> stack = {order[i]};
        reached[order[i]] = true;
        while (!stack.empty()) {
          const std::uint32_t v = stack.back();
          stack.pop_back();
          leader[v] = order[i];
          for (const std::uint32_t n : neighbours[v]) {
            if (position[n] > threshold || reached[n]) continue;
            reached[n] = true;
            stack.push_back(n);
          }
        }
      }
      for (const std::uint32_t dead : alive) {
        if (leaders.contains(dead)) continue;
        const double persistence = std::abs(s.heights[order[threshold]] - s.heights[dead]);
        if (persistence == 0) continue;
        found.push_back(feature(s, sign > 0 ? Kind::pit : Kind::peak, dead, persistence));
        found.push_back(feature(s, Kind::pass, order[threshold], persistence));
      }
      alive = leaders;
    }
    for (const std::uint32_t v : order) (sign > 0 ? lowestOf : highestOf)[v] = leader[v];
  }
  for (const auto& [v, low] : lowestOf) {
    if (v != low) continue;
    const std::uint32_t high = highestOf.at(v);
    const double range = s.heights[high] - s.heights[low];
    if (range == 0) continue;
    found.push_back(feature(s, Kind::pit, low, range));
    found.push_back(feature(s, Kind::peak, high, range));
  }
  std::sort(found.begin(), found.end(), [](const Feature& a, const Feature& b) {
    return std::tuple(-a.persistence, a.sample, a.kind) < std::tuple(-b.persistence, b.sample, b.kind);
  });
  return found;
}

}  // namespace arete::features_test
