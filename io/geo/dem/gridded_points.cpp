// SPDX-License-Identifier: GPL-3.0-or-later
//
// The distinct x are sorted; their number and range give the step, and each must lie on it. The same for y.
// Scattered points have about as many distinct x as points, and are detected by that first. A pattern that
// fills half of a grid but has few cells, such as a checkerboard, counts as scattered too: as a raster, most
// of its points would be in no triangle.
#include "io/geo/dem/gridded_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace arete {
namespace {

constexpr double kStepTolerance = 0.01;

struct Axis {
  double first = 0;
  double step = 0;
  std::size_t count = 0;

  std::size_t indexOf(double value) const { return std::size_t(std::llround((value - first) / step)); }
};

std::optional<Axis> regularAxis(std::vector<double> values, std::size_t largestCount) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.size() < 2 || values.size() > largestCount) return std::nullopt;
  const Axis axis{values.front(), (values.back() - values.front()) / double(values.size() - 1),
                  values.size()};
  // Coordinates at the limits of double have no step between them.
  if (!std::isnormal(axis.step) || !std::isfinite(axis.step * double(axis.count))) return std::nullopt;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::abs(values[i] - (axis.first + double(i) * axis.step)) > kStepTolerance * axis.step)
      return std::nullopt;
  return axis;
}

std::optional<Axis> axisOf(const PointHeightfield& points, double Vec2::*coordinate) {
  std::vector<double> values(points.size());
  std::transform(points.positions.begin(), points.positions.end(), values.begin(),
                 [&](const Vec2& p) { return p.*coordinate; });
  // At least half of the samples are present and the other axis has at least two, so no axis has more values
  // than there are points.
  return regularAxis(std::move(values), points.size());
}

/// True if most of the points are corners of a cell with at least three valid corners, thus of a triangle.
bool hasCellsForMost(const RasterHeightfield& raster, std::size_t points) {
  const auto isValid = [&](std::size_t sample) { return !std::isnan(raster.heights[sample]); };
  std::vector<bool> hasCell(raster.heights.size());
  for (std::size_t row = 0; row + 1 < raster.rows; ++row)
    for (std::size_t column = 0; column + 1 < raster.columns; ++column) {
      const std::size_t first = row * raster.columns + column;
      const std::array corners = {first, first + 1, first + raster.columns, first + raster.columns + 1};
      if (std::ranges::count_if(corners, isValid) >= 3)
        for (const std::size_t corner : corners) hasCell[corner] = hasCell[corner] || isValid(corner);
    }
  return 2 * std::size_t(std::ranges::count(hasCell, true)) > points;
}

}  // namespace

std::optional<RasterHeightfield> asRaster(const PointHeightfield& points) {
  if (points.size() < 4) return std::nullopt;
  const auto x = axisOf(points, &Vec2::x);
  if (!x) return std::nullopt;
  const auto y = axisOf(points, &Vec2::y);
  if (!y || x->count * y->count > 2 * points.size() || !std::isnormal(x->step * y->step)) return std::nullopt;

  RasterHeightfield raster;
  raster.columns = std::uint32_t(x->count);
  raster.rows = std::uint32_t(y->count);
  raster.heights.assign(x->count * y->count, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t column = x->indexOf(points.positions[i].x);
    const std::size_t row = y->count - 1 - y->indexOf(points.positions[i].y);
    raster.heights[row * x->count + column] = points.heights[i];
  }
  if (!hasCellsForMost(raster, points.size())) return std::nullopt;
  const double top = y->first + y->step * double(y->count - 1);
  raster.georeference = points.georeference;
  raster.georeference.geoTransform = {x->first - x->step / 2, x->step, 0, top + y->step / 2, 0, -y->step};
  raster.georeference.hasGeoTransform = true;
  raster.source = points.source;
  raster.sourceChecksum = heightsChecksum(raster);
  return raster;
}

}  // namespace arete
