// SPDX-License-Identifier: GPL-3.0-or-later
//
// A window is filled triangle by triangle: of each row of samples those between the edges, borders included.
// A sample on an edge is in two triangles of the same height there.
#include "gis/driver/pixel_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "terrain/model/cell_grid.h"
#include "terrain/model/plan_box.h"

namespace arete {
namespace {

/// Of a pixel: a sample so near beyond an edge is on it, because coordinates are rounded.
constexpr double kOnEdge = 1e-9;
/// Triangles in a bin, about.
constexpr double kPerBin = 8;

}  // namespace

Result<PixelGrid> PixelGrid::of(const TerrainModel& outline, std::optional<double> cell) {
  PixelGrid grid;
  grid.model_ = &outline;
  if (outline.isRaster && !cell) {
    // A source that goes round the Earth has its first column once.
    grid.columns = static_cast<int>(sourceColumns(outline));
    grid.rows = static_cast<int>(outline.rows);
    grid.geoTransform = outline.georeference.geoTransform;
    grid.isOfSource_ = true;
    return grid;
  }
  const Result<CellGrid> cells = cellGridOf(outline, *cell);
  if (!cells) return failure(cells.error().code, cells.error().message, "CELL");
  grid.columns = cells->columns;
  grid.rows = cells->rows;
  grid.geoTransform = cells->geoTransform;
  return grid;
}

// Pixels of the source have their samples in the middle, at whole numbers of plan coordinates.
Vec2 PixelGrid::pixelOf(Vec2 plan) const {
  if (isOfSource_) return {plan.x + 0.5, plan.y + 0.5};
  const Vec2 p = model_->toSource(plan);
  return {(p.x - geoTransform[0]) / geoTransform[1], (p.y - geoTransform[3]) / geoTransform[5]};
}

Box2 PixelGrid::planBoxOf(double left, double top, double right, double bottom) const {
  if (isOfSource_) return {left - 0.5, top - 0.5, right - 0.5, bottom - 0.5};
  std::vector<Vec2> corners;
  for (const double x : {left, right})
    for (const double y : {top, bottom})
      corners.push_back(
          model_->toPlan({geoTransform[0] + x * geoTransform[1], geoTransform[3] + y * geoTransform[5]}));
  return planBox(corners);
}

// Triangles are put into bins by their boxes, a few to a bin, so that a window looks at those near it only. A
// prefix sum gives each bin a part of one array.
TriangleBins::TriangleBins(GridTriangles triangles) : triangles_(std::move(triangles)) {
  if (triangles_.triangles.empty()) return;
  const auto& corners = triangles_.corners;
  const auto [x0, x1] = std::ranges::minmax(corners, {}, [](const auto& c) { return c.pixel.x; });
  const auto [y0, y1] = std::ranges::minmax(corners, {}, [](const auto& c) { return c.pixel.y; });
  left_ = x0.pixel.x;
  top_ = y0.pixel.y;
  width_ = std::max(x1.pixel.x - left_, 1e-9);
  height_ = std::max(y1.pixel.y - top_, 1e-9);
  const double side = std::sqrt(width_ * height_ * kPerBin / double(triangles_.triangles.size()));
  across_ = static_cast<int>(std::clamp(width_ / side, 1.0, 4096.0));
  down_ = static_cast<int>(std::clamp(height_ / side, 1.0, 4096.0));
  const auto forBins = [&](const std::array<std::uint32_t, 3>& t, const auto& visit) {
    Box2 box{corners[t[0]].pixel.x, corners[t[0]].pixel.y, corners[t[0]].pixel.x, corners[t[0]].pixel.y};
    for (const std::uint32_t v : t) {
      const Vec2 p = corners[v].pixel;
      box = {std::min(box.xMin, p.x), std::min(box.yMin, p.y), std::max(box.xMax, p.x),
             std::max(box.yMax, p.y)};
    }
    const auto bin = [](double at, double from, double size, int count) {
      return std::clamp(static_cast<int>((at - from) / size * count), 0, count - 1);
    };
    // A triangle across several bins is in each of them; fill() removes the repeats.
    for (int y = bin(box.yMin, top_, height_, down_); y <= bin(box.yMax, top_, height_, down_); ++y)
      for (int x = bin(box.xMin, left_, width_, across_); x <= bin(box.xMax, left_, width_, across_); ++x)
        visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(x));
  };
  begin_.assign(static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_) + 1, 0);
  for (const auto& t : triangles_.triangles) forBins(t, [&](std::size_t bin) { ++begin_[bin + 1]; });
  for (std::size_t b = 1; b < begin_.size(); ++b) begin_[b] += begin_[b - 1];
  members_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t t = 0; t < triangles_.triangles.size(); ++t)
    forBins(triangles_.triangles[t], [&](std::size_t bin) { members_[next[bin]++] = t; });
}

void TriangleBins::fill(const PixelWindow& window, std::span<double> heights, std::size_t stride) const {
  for (int row = 0; row < window.rows; ++row)
    std::fill_n(heights.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(row) * stride),
                window.columns, std::numeric_limits<double>::quiet_NaN());
  if (triangles_.triangles.empty() || window.columns <= 0 || window.rows <= 0) return;
  // Samples are at whole numbers of these coordinates.
  const double perColumn = window.columns / window.width, perRow = window.rows / window.height;
  const auto sampleOf = [&](Vec2 pixel) {
    return Vec2{(pixel.x - window.left) * perColumn - 0.5, (pixel.y - window.top) * perRow - 0.5};
  };
  const auto fillTriangle = [&](const std::array<std::uint32_t, 3>& t) {
    std::array<Vec2, 3> p;
    std::array<double, 3> z{};
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = sampleOf(triangles_.corners[t[i]].pixel);
      z[i] = triangles_.corners[t[i]].height;
    }
    // Triangles are turned counter-clockwise, so that all shares are positive inside. One without area has no
    // pixels.
    double area = cross(p[1] - p[0], p[2] - p[0]);
    if (area < 0) {
      std::swap(p[1], p[2]);
      std::swap(z[1], z[2]);
      area = -area;
    }
    if (!(area > 0)) return;
    const auto [low, high] = std::minmax({p[0].y, p[1].y, p[2].y});
    const auto [first, last] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto clamped = [](double x, int count) {
      return static_cast<int>(std::clamp(x, -1.0, double(count)));
    };
    const int rowBegin = std::max(0, clamped(std::ceil(low - kOnEdge), window.rows)),
              rowEnd = std::min(window.rows - 1, clamped(std::floor(high + kOnEdge), window.rows));
    const int columnBegin = std::max(0, clamped(std::ceil(first - kOnEdge), window.columns)),
              columnEnd = std::min(window.columns - 1, clamped(std::floor(last + kOnEdge), window.columns));
    // A sample on an edge may be off by rounding, so a share may be slightly negative, in proportion to the
    // side.
    std::array<double, 3> slack{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 side = p[(i + 2) % 3] - p[(i + 1) % 3];
      slack[i] = -kOnEdge * (std::abs(side.x) + std::abs(side.y));
    }
    for (int row = rowBegin; row <= rowEnd; ++row)
      for (int column = columnBegin; column <= columnEnd; ++column) {
        const Vec2 q{double(column), double(row)};
        const std::array<double, 3> share = {cross(p[2] - p[1], q - p[1]), cross(p[0] - p[2], q - p[2]),
                                             cross(p[1] - p[0], q - p[0])};
        if (share[0] < slack[0] || share[1] < slack[1] || share[2] < slack[2]) continue;
        double height = z[0] + (share[1] * (z[1] - z[0]) + share[2] * (z[2] - z[0])) / area;
        // At a corner the height is the corner's own, to the bit.
        for (std::size_t i = 0; i < 3; ++i)
          if (share[i] == area) height = z[i];
        heights[static_cast<std::size_t>(row) * stride + static_cast<std::size_t>(column)] = height;
      }
  };
  const auto bin = [](double at, double from, double size, int count) {
    return std::clamp(static_cast<int>(std::floor(std::clamp((at - from) / size, -1.0, 2.0) * count)), 0,
                      count - 1);
  };
  const int y0 = bin(window.top, top_, height_, down_),
            y1 = bin(window.top + window.height, top_, height_, down_);
  const int x0 = bin(window.left, left_, width_, across_),
            x1 = bin(window.left + window.width, left_, width_, across_);
  std::vector<std::uint32_t> some;
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const std::size_t b =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(x);
      some.insert(some.end(), members_.begin() + begin_[b], members_.begin() + begin_[b + 1]);
    }
  // Triangles are filled in the order of their numbers, so that a sample on an edge does not depend on the
  // window.
  std::ranges::sort(some);
  const auto last = std::unique(some.begin(), some.end());
  some.erase(last, some.end());
  for (const std::uint32_t t : some) fillTriangle(triangles_.triangles[t]);
}

}  // namespace arete
