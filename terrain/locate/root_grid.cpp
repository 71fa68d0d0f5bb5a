// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle is clipped to one row of cells after the other, each widened by the margin, and listed in the
// cells between its least and largest x there. So a long thin triangle is listed along its length, not in its
// whole bounding box. The margin is far larger than the rounding error of a position; an extra triangle in a
// list only costs a test.
#include "terrain/locate/root_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace arete {
namespace {

constexpr std::size_t kMostListed = 64;  // cells per root triangle, on average

/// The cell of `count` that holds a place, in cells from the first. NaN, where bounds overflow doubles or
/// have no extent, is in the first.
std::uint32_t cellOf(double place, std::uint32_t count) {
  return place > 0 ? static_cast<std::uint32_t>(std::min(place, count - 1.0)) : 0;
}

/// The interval of x of a triangle within a band of y; empty (first > second) where it does not meet the
/// band.
std::pair<double, double> extentInBand(const std::array<Vec2, 3>& triangle, double low, double high) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  const auto include = [&](double x) {
    least = std::min(least, x);
    most = std::max(most, x);
  };
  for (int i = 0; i < 3; ++i) {
    const Vec2 a = triangle[i], b = triangle[(i + 1) % 3];
    if (a.y >= low && a.y <= high) include(a.x);
    for (const double y : {low, high})
      if ((a.y < y) != (b.y < y)) include(a.x + (b.x - a.x) * std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0));
  }
  return {least, most};
}

}  // namespace

RootGrid::RootGrid(const MultiTriangulation& mt, double margin) {
  const auto rootTriangles = mt.rootTriangles();
  if (rootTriangles.empty()) {
    begin_.assign(2, 0);
    bounds_ = {0, 0, -1, -1};
    return;
  }
  std::vector<std::array<Vec2, 3>> triangles;
  triangles.reserve(rootTriangles.size());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  bounds_ = {kInfinity, kInfinity, -kInfinity, -kInfinity};
  for (const auto& corners : rootTriangles) {
    triangles.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const Vec2 p = triangles.back()[i] = mt.vertices().planPosition(VertexId(corners[i]));
      bounds_.xMin = std::min(bounds_.xMin, p.x);
      bounds_.xMax = std::max(bounds_.xMax, p.x);
      bounds_.yMin = std::min(bounds_.yMin, p.y);
      bounds_.yMax = std::max(bounds_.yMax, p.y);
    }
  }
  margin_ = margin + 1e-9 * std::max(bounds_.xMax - bounds_.xMin, bounds_.yMax - bounds_.yMin);

  // Needles across the whole terrain, or overlapping triangles (in an invalid file), could make the lists too
  // long: then the cells are made larger.
  double cells = static_cast<double>(triangles.size());
  do {
    layCells(cells);
    cells /= 4;
  } while (!countLists(triangles, kMostListed * (triangles.size() + kMostListed)) && begin_.size() > 2);

  // The counts become the beginnings of the lists by a prefix sum, and a second walk fills them.
  for (std::size_t cell = 1; cell < begin_.size(); ++cell) begin_[cell] += begin_[cell - 1];
  triangles_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    forCellsOf(triangles[t], [&](std::size_t cell) { triangles_[next[cell]++] = TriangleId(t); });
}

/// The cells are about square, whatever the shape of the domain; along a side there are never more than
/// wanted in all.
void RootGrid::layCells(double about) {
  const double width = bounds_.xMax - bounds_.xMin, height = bounds_.yMax - bounds_.yMin;
  const bool hasAspect = width > 0 && height > 0 && std::isfinite(width) && std::isfinite(height);
  const double aspect = hasAspect ? width / height : 1;
  const auto along = [&](double count) {
    return static_cast<std::uint32_t>(std::clamp(std::round(std::sqrt(count)), 1.0, std::max(1.0, about)));
  };
  columns_ = along(about * aspect);
  rows_ = along(about / aspect);
  cellWidth_ = width > 0 ? width / columns_ : 1;
  cellHeight_ = height > 0 ? height / rows_ : 1;
}

/// The walk ends as soon as the lists are too long, so that needles cost no more than good triangles.
bool RootGrid::countLists(std::span<const std::array<Vec2, 3>> triangles, std::size_t most) {
  begin_.assign(std::size_t(columns_) * rows_ + 1, 0);
  std::size_t total = 0;
  for (const auto& triangle : triangles) {
    forCellsOf(triangle, [&](std::size_t cell) {
      ++begin_[cell + 1];
      ++total;
    });
    if (total > most) return false;
  }
  return true;
}

std::uint32_t RootGrid::column(double x) const {
  return cellOf((x - bounds_.xMin) / cellWidth_, columns_);
}

std::uint32_t RootGrid::row(double y) const {
  return cellOf((y - bounds_.yMin) / cellHeight_, rows_);
}

// The extent of the triangle in one row of cells, and not its whole bounding box, says which columns it
// reaches.
template <class Visit>
void RootGrid::forCellsOf(const std::array<Vec2, 3>& triangle, const Visit& visit) const {
  const auto [yMin, yMax] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
  const std::uint32_t lastRow = row(yMax + margin_);
  for (std::uint32_t r = row(yMin - margin_); r <= lastRow; ++r) {
    const double low = bounds_.yMin + r * cellHeight_ - margin_;
    const auto [xMin, xMax] = extentInBand(triangle, low, low + cellHeight_ + 2 * margin_);
    if (xMin > xMax) continue;
    const std::uint32_t lastColumn = column(xMax + margin_);
    for (std::uint32_t c = column(xMin - margin_); c <= lastColumn; ++c) visit(std::size_t(r) * columns_ + c);
  }
}

// The cell's list has every triangle at the place; one that the margin alone has put there is found out by
// the caller's test.
std::span<const TriangleId> RootGrid::near(Vec2 p) const {
  if (!(p.x >= bounds_.xMin - margin_ && p.x <= bounds_.xMax + margin_ && p.y >= bounds_.yMin - margin_ &&
        p.y <= bounds_.yMax + margin_))
    return {};
  const std::size_t cell = std::size_t(row(p.y)) * columns_ + column(p.x);
  return std::span(triangles_).subspan(begin_[cell], begin_[cell + 1] - begin_[cell]);
}

// A segment is listed as a triangle with two equal corners. Triangles of several cells are listed once.
void RootGrid::along(Vec2 from, Vec2 to, std::vector<TriangleId>& triangles) const {
  triangles.clear();
  if (triangles_.empty() || !std::isfinite(from.x + from.y + to.x + to.y)) return;
  forCellsOf({from, to, to}, [&](std::size_t cell) {
    triangles.insert(triangles.end(), triangles_.begin() + begin_[cell],
                     triangles_.begin() + begin_[cell + 1]);
  });
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
}

}  // namespace arete
