// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle's points are looked for in the cells, row by row, between the outermost cells that its edges
// meet. Edges of the finest triangulation that cross one of its edges share a cell with it. Intervals of
// cells are computed in doubles and widened by a cell to either side.
#include "terrain/laws/point_error_law.h"

#include <algorithm>
#include <limits>

#include "terrain/model/plan_orientation.h"

namespace arete::laws {
namespace {

Vec2 planOf(const Vec3& p) {
  return {p.x, p.y};
}

}  // namespace

PointErrorLaw::PointErrorLaw(const MultiTriangulation& mt, const Cut& finest) : mt_(mt) {
  const std::uint32_t points = mt.vertexCount();
  low_ = high_ = planOf(position(0));
  for (std::uint32_t v = 0; v < points; ++v) {
    const Vec2 p = planOf(position(v));
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
    high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
  }
  // About two points a cell, and no more cells in a row or column than points.
  const double width = high_.x - low_.x, height = high_.y - low_.y;
  side_ = std::max({std::sqrt(width) * std::sqrt(height) * std::sqrt(2.0 / points), width / points,
                    height / points, std::numeric_limits<double>::min()});
  columns_ = static_cast<std::int64_t>(width / side_) + 1;
  rows_ = static_cast<std::int64_t>(height / side_) + 1;

  pointsOf_.begin.assign(cellOf(0, rows_) + 1, 0);
  const auto cellOfPoint = [&](std::uint32_t v) {
    const Vec3 p = position(v);
    return cellOf(columnOf(p.x), rowOf(p.y));
  };
  for (std::uint32_t v = 0; v < points; ++v) ++pointsOf_.begin[cellOfPoint(v) + 1];
  for (std::size_t i = 1; i < pointsOf_.begin.size(); ++i) pointsOf_.begin[i] += pointsOf_.begin[i - 1];
  pointsOf_.things.resize(points);
  std::vector<std::uint32_t> next(pointsOf_.begin.begin(), pointsOf_.begin.end() - 1);
  for (std::uint32_t v = 0; v < points; ++v) pointsOf_.things[next[cellOfPoint(v)]++] = v;

  for (const auto& t : finest.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = finest.vertices[t[i]], to = finest.vertices[t[(i + 1) % 3]];
      edges_.push_back({std::min(from, to), std::max(from, to)});
    }
  std::ranges::sort(edges_);
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  edgesOf_ = listEdges();
}

std::int64_t PointErrorLaw::columnOf(double x) const {
  return std::clamp(static_cast<std::int64_t>((x - low_.x) / side_), std::int64_t{0}, columns_ - 1);
}

std::int64_t PointErrorLaw::rowOf(double y) const {
  return std::clamp(static_cast<std::int64_t>((y - low_.y) / side_), std::int64_t{0}, rows_ - 1);
}

PointErrorLaw::CellRange PointErrorLaw::cellsOf(Vec2 a, Vec2 b, std::int64_t row) const {
  // The strip of the row, widened by a cell.
  const double bottom = low_.y + double(row - 1) * side_, top = low_.y + double(row + 2) * side_;
  if (std::max(a.y, b.y) < bottom || std::min(a.y, b.y) > top) return {1, 0};
  const auto xAt = [&](double y) {
    const double t = std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0);
    return a.x + t * (b.x - a.x);
  };
  // An edge that is not level meets the row between its places on the lower and the upper line of the strip.
  double from = a.x, to = b.x;
  if (a.y != b.y) {
    from = xAt(bottom);
    to = xAt(top);
  }
  return {std::max(columnOf(std::min(from, to)) - 1, std::int64_t{0}),
          std::min(columnOf(std::max(from, to)) + 1, columns_ - 1)};
}

template <class Visit>
void PointErrorLaw::forCells(Vec2 a, Vec2 b, const Visit& visit) const {
  for (std::int64_t row = rowOf(std::min(a.y, b.y)), last = rowOf(std::max(a.y, b.y)); row <= last; ++row) {
    const CellRange cells = cellsOf(a, b, row);
    if (cells.first <= cells.last) visit(cellOf(cells.first, row), cellOf(cells.last, row) + 1);
  }
}

PointErrorLaw::Lists PointErrorLaw::listEdges() const {
  Lists lists;
  lists.begin.assign(cellOf(0, rows_) + 1, 0);
  // The edges are visited twice, to count them in each cell and to list them.
  const auto forEach = [&](const auto& visit) {
    for (std::uint32_t e = 0; e < edges_.size(); ++e)
      forCells(planOf(position(edges_[e][0])), planOf(position(edges_[e][1])),
               [&](std::size_t first, std::size_t end) {
                 for (std::size_t cell = first; cell < end; ++cell) visit(cell, e);
               });
  };
  forEach([&](std::size_t cell, std::uint32_t) { ++lists.begin[cell + 1]; });
  for (std::size_t i = 1; i < lists.begin.size(); ++i) lists.begin[i] += lists.begin[i - 1];
  lists.things.resize(lists.begin.back());
  std::vector<std::uint32_t> next(lists.begin.begin(), lists.begin.end() - 1);
  forEach([&](std::size_t cell, std::uint32_t e) { lists.things[next[cell]++] = e; });
  return lists;
}

bool PointErrorLaw::holds(std::uint32_t triangle) const {
  const StoredErrors stored = storedErrors(mt_, triangle);
  const auto corners = mt_.corners(TriangleId(triangle));
  return holdsAtPoints(stored, corners) && holdsAlong(stored, corners[0], corners[1]) &&
         holdsAlong(stored, corners[1], corners[2]) && holdsAlong(stored, corners[2], corners[0]);
}

bool PointErrorLaw::holdsAtPoints(const StoredErrors& stored,
                                  const std::array<std::uint32_t, 3>& corners) const {
  std::array<Vec3, 3> corner;
  for (std::size_t i = 0; i < 3; ++i) corner[i] = position(corners[i]);
  const auto& [a, b, c] = corner;
  const Vec2 pa = planOf(a), pb = planOf(b), pc = planOf(c);
  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y, riseB = b.z - a.z,
               riseC = c.z - a.z;
  // The magnitudes of the terms bound the rounding of the area, however small the area is.
  const double terms = std::abs(bx * cy) + std::abs(by * cx), area = bx * cy - by * cx;
  const bool isLevel = riseB == 0 && riseC == 0;
  for (std::int64_t row = rowOf(std::min({a.y, b.y, c.y})), last = rowOf(std::max({a.y, b.y, c.y}));
       row <= last; ++row) {
    CellRange cells{columns_, -1};
    for (const auto& [from, to] : {std::pair(pa, pb), std::pair(pb, pc), std::pair(pc, pa)}) {
      const CellRange side = cellsOf(from, to, row);
      if (side.first > side.last) continue;
      cells = {std::min(cells.first, side.first), std::max(cells.last, side.last)};
    }
    if (cells.first > cells.last) continue;
    for (const std::uint32_t point : pointsOf_.of(cellOf(cells.first, row), cellOf(cells.last, row) + 1)) {
      const Vec3 p = position(point);
      // Orientations are exact, so points on an edge count as inside.
      const Vec2 at = planOf(p);
      if (planOrientation(pa, pb, at) < 0 || planOrientation(pb, pc, at) < 0 ||
          planOrientation(pc, pa, at) < 0)
        continue;
      const double x = p.x - a.x, y = p.y - a.y;
      const double u = (x * cy - y * cx) / area, w = (bx * y - by * x) / area;
      const double difference = isLevel ? a.z - p.z : (a.z - p.z) + u * riseB + w * riseC;
      // A triangle of few digits has no useful bound: it is infinite or NaN, and exact arithmetic decides.
      const double rounding =
          isLevel ? 0
                  : 0x1p-46 * (std::abs(riseB) + std::abs(riseC)) * (1 + 4 * terms / std::abs(area)) +
                        0x1p-50 * std::abs(difference) + 0x1p-1030;
      const bool isReliable = isLevel || std::abs(area) > 0x1p-900;
      if (isReliable && stored.hold(difference, rounding)) continue;
      if (!holdAtSample(stored, corner, p)) return false;
    }
  }
  return true;
}

bool PointErrorLaw::holdsAlong(const StoredErrors& stored, std::uint32_t a, std::uint32_t b) const {
  const Vec3 from = position(a), to = position(b);
  const Vec2 pa = planOf(from), pb = planOf(to);
  bool isHeld = true;
  forCells(pa, pb, [&](std::size_t first, std::size_t end) {
    if (!isHeld) return;
    for (const std::uint32_t e : edgesOf_.of(first, end)) {
      const auto& [u, v] = edges_[e];
      if (u == a || u == b || v == a || v == b) continue;
      const Vec3 p = position(u), q = position(v);
      // What the bound would have to be if the crossing could be anywhere on both edges.
      const auto [least, most] = std::minmax({from.z, to.z});
      const auto [low, high] = std::minmax({p.z, q.z});
      if (stored.holdBound(most - low, 0) && stored.holdBound(least - high, 0)) continue;
      const Vec2 pp = planOf(p), pq = planOf(q);
      if (planOrientation(pa, pb, pp) * planOrientation(pa, pb, pq) >= 0) continue;
      if (planOrientation(pp, pq, pa) * planOrientation(pp, pq, pb) >= 0) continue;
      if (holdAtCrossing(stored, from, to, p, q)) continue;
      isHeld = false;
      return;
    }
  });
  return isHeld;
}

}  // namespace arete::laws
