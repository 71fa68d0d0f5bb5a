// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "viewer/picture/picture.h"

namespace arete {

struct ChartSeries {
  std::string name = {};
  std::vector<Vec2> points = {};  ///< in the order in which lines join them; both coordinates > 0
  bool dashed = false;            ///< for a reference
};

struct ChartOptions {
  int width = 1200, height = 800;  ///< pixels
  std::string title = {};
  std::string subtitle = {};
  std::string xLabel = {}, yLabel = {};
};

/// A line chart with two logarithmic axes, such as triangles against tolerance. Series differ in colour (from
/// the palette of Okabe and Ito, which colour-blind people can tell apart) and in the shape of their marks.
/// Errors: usage: the size leaves no room for the chart; invalidData, naming the series: a coordinate is not
/// positive and finite, so has no logarithm. O(points).
Result<Canvas> drawLogLogChart(std::span<const ChartSeries> series, const ChartOptions& options = {});

}  // namespace arete
