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
  std::vector<Vec2> points = {};  ///< in the order they are joined, both coordinates > 0
  bool dashed = false;            ///< for a reference
};

struct ChartOptions {
  int width = 1200, height = 800;  ///< pixels
  std::string title = {};
  std::string subtitle = {};
  std::string xLabel = {}, yLabel = {};
};

/// A line chart with two logarithmic axes, such as triangles against tolerance. Series differ in
/// colour (of the palette of Okabe and Ito, made for any colour vision) and by the shape of their marks. A
/// series with a point that is not positive and finite is an error, because it has no logarithm. Errors:
/// usage, for a size without room; invalidData, naming the series. O(points).
Result<Canvas> drawLogLogChart(std::span<const ChartSeries> series, const ChartOptions& options = {});

}  // namespace arete
