// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle is scanned row by row. Its left and right edges are followed in integers (quotient and
// remainder, as a line is drawn), so that the samples exactly on an edge are always counted, and the plane is
// stepped along the row.
//
// The difference between a triangle and the finest triangulation is linear on every piece of the overlay of
// the two, so its extremes lie at the overlay's vertices: samples inside the triangle, its corners (where it
// is zero) and crossings of its edges with edges of the finest triangulation: grid columns, grid rows and the
// diagonals of the cells, which run from the upper-left to the lower-right sample and are the lines column -
// row = constant. Where a triangle reaches beyond the domain's rim, the rim's own half cells add the other
// diagonals.
#include "terrain/raster_error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace arete {
namespace {

/// Where a line by rows, x = x0 + (y - y0) dx / dy, stands: rounded down, or up. Starts one row below y0.
class EdgeStepper {
 public:
  EdgeStepper(std::int32_t x0, std::int32_t dx, std::int32_t dy, bool roundUp) {
    // ceil(a / b) = floor((a + b - 1) / b) for b > 0.
    denominator_ = dy;
    step_ = dx / dy;
    rest_ = dx - step_ * dy;
    if (rest_ < 0) {
      --step_;
      rest_ += dy;
    }
    x_ = x0;
    remainder_ = roundUp ? dy - 1 : 0;
    advance();
  }
  std::int32_t x() const { return x_; }
  void advance() {
    x_ += step_;
    remainder_ += rest_;
    if (remainder_ >= denominator_) {
      remainder_ -= denominator_;
      ++x_;
    }
  }

 private:
  std::int32_t x_, step_, rest_, remainder_, denominator_;
};

}  // namespace

/// Half of the triangles a build asks about cover one sample beside their corners, or none: by Pick's theorem
/// those of twice the area 1 none, of 2 the middle of an edge, of 3 their centroid, unless an edge has two.
/// Then `difference` is z_plane - z there. Over NODATA, 0.
[[gnu::always_inline]] inline bool RasterError::isSmall(const Corner& a, const Corner& b, const Corner& c,
                                                        double& difference) const {
  const std::int64_t area = std::int64_t(b.x - a.x) * (c.y - a.y) - std::int64_t(b.y - a.y) * (c.x - a.x);
  if (area > 3) return false;
  std::int64_t x, y;
  double z;
  if (area == 2) {
    const bool isAB = (((b.x - a.x) | (b.y - a.y)) & 1) == 0, isBC = (((c.x - b.x) | (c.y - b.y)) & 1) == 0;
    const Corner &u = isAB ? a : c, &v = isAB || isBC ? b : a;
    x = (u.x + v.x) / 2;
    y = (u.y + v.y) / 2;
    z = (u.z + v.z) / 2;
  } else if (area == 3) {
    x = std::int64_t(a.x) + b.x + c.x;
    y = std::int64_t(a.y) + b.y + c.y;
    if (x % 3 != 0 || y % 3 != 0) return false;
    x /= 3;
    y /= 3;
    z = (a.z + b.z + c.z) / 3;
  } else {
    difference = 0;
    return true;
  }
  const double height = heights_[std::size_t(y) * plan_.columns() + std::size_t(x)];
  difference = height == height ? z - height : 0;
  return true;
}

/// Calls row(first sample, count, plane at the first sample, plane step per column); stops when it returns
/// false. The corners are left out: there the plane is the sample.
template <class Row>
void RasterError::forRows(const Corner& a, const Corner& b, const Corner& c, const Row& row) const {
  const std::int64_t area = std::int64_t(b.x - a.x) * (c.y - a.y) - std::int64_t(b.y - a.y) * (c.x - a.x);

  const Corner *p = &a, *q = &b, *r = &c;
  if (q->y < p->y) std::swap(p, q);
  if (r->y < q->y) std::swap(q, r);
  if (q->y < p->y) std::swap(p, q);
  const std::int32_t top = p->y, middle = q->y, bottom = r->y;

  // Corner a anchors the plane.
  const double inverse = 1.0 / double(area);
  const double stepX = ((b.z - a.z) * double(c.y - a.y) - (c.z - a.z) * double(b.y - a.y)) * inverse;
  const double stepY = ((c.z - a.z) * double(b.x - a.x) - (b.z - a.z) * double(c.x - a.x)) * inverse;
  const std::size_t columns = plan_.columns();
  const auto emit = [&](std::int32_t y, std::int32_t left, std::int32_t right) {
    if (left > right) return true;
    const double z = a.z + stepX * double(left - a.x) + stepY * double(y - a.y);
    return row(std::size_t(y) * columns + std::size_t(left), std::size_t(right - left + 1), z, stepX);
  };
  const auto emitBetween = [&](const Corner& u, const Corner& v) {  // the inside of a horizontal edge
    return emit(u.y, std::min(u.x, v.x) + 1, std::max(u.x, v.x) - 1);
  };

  if (top == middle && !emitBetween(*p, *q)) return;
  if (bottom - top > 1) {
    // The long edge p-r on one side, p-q and then q-r on the other.
    const bool middleIsRight =
        std::int64_t(q->x - p->x) * (bottom - top) > std::int64_t(middle - top) * (r->x - p->x);
    EdgeStepper along(p->x, r->x - p->x, bottom - top, middleIsRight);
    EdgeStepper bent = middle > top ? EdgeStepper(p->x, q->x - p->x, middle - top, !middleIsRight)
                                    : EdgeStepper(q->x, r->x - q->x, bottom - middle, !middleIsRight);
    const std::int32_t beside = middleIsRight ? -1 : 1;
    for (std::int32_t y = top + 1; y < bottom; ++y) {
      const std::int32_t other = y == middle ? q->x + beside : bent.x();
      if (!emit(y, middleIsRight ? along.x() : other, middleIsRight ? other : along.x())) return;
      along.advance();
      if (y == middle)
        bent = EdgeStepper(q->x, r->x - q->x, bottom - middle, !middleIsRight);
      else
        bent.advance();
    }
  }
  if (middle == bottom) emitBetween(*q, *r);
}

double RasterError::maximum(const Corner& a, const Corner& b, const Corner& c, double limit) const {
  double worst = 0;
  if (isSmall(a, b, c, worst)) return std::abs(worst);
  forRows(a, b, c, [&](std::size_t first, std::size_t count, double z, double step) {
    const double* height = heights_.data() + first;
    double rowWorst = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double difference = std::abs(height[i] - (z + step * double(i)));
      rowWorst = difference > rowWorst ? difference : rowWorst;  // false for NODATA
    }
    worst = rowWorst > worst ? rowWorst : worst;
    return worst <= limit;
  });
  return worst;
}

double RasterError::maximum(const Corner& a, const Corner& b, const Corner& c, SignedBound& bound) const {
  double high = 0, low = 0, only = 0;
  if (isSmall(a, b, c, only)) {
    bound.include(only);
    return std::abs(only);
  }
  forRows(a, b, c, [&](std::size_t first, std::size_t count, double z, double step) {
    const double* height = heights_.data() + first;
    for (std::size_t i = 0; i < count; ++i) {
      const double difference = (z + step * double(i)) - height[i];
      high = difference > high ? difference : high;
      low = difference < low ? difference : low;
    }
    return true;
  });
  bound.above = std::max(bound.above, high);
  bound.below = std::max(bound.below, -low);
  return std::max(high, -low);
}

SignedBound RasterError::alongEdge(const Corner& a, const Corner& b) const {
  const std::int64_t x0 = a.x, y0 = a.y, dx = b.x - a.x, dy = b.y - a.y;
  // Edges of the finest triangulation cross none of it.
  if (std::abs(dx) + std::abs(dy) <= 1 || (dx == dy && std::abs(dx) == 1 && !reachesBeyondRims_)) return {};
  const double z0 = a.z, dz = b.z - a.z;
  const std::size_t columns = plan_.columns();
  double high = 0, low = 0;
  const auto compare = [&](double difference) {
    high = difference > high ? difference : high;
    low = difference < low ? difference : low;
  };

  if (dx != 0 && dy != 0) {
    const double inverseX = 1.0 / double(dx), slope = double(dy) * inverseX;
    const std::int64_t stepX = dx > 0 ? 1 : -1;
    for (std::int64_t k = 1; k < std::abs(dx); ++k) {  // grid columns
      const double t = double(k * stepX) * inverseX, y = double(y0) + slope * double(k * stepX);
      const double base = double(std::int64_t(y)), f = y - base;
      const double* h = heights_.data() + std::size_t(base) * columns + std::size_t(x0 + k * stepX);
      if (f == 0) continue;  // a sample: the scan has it
      compare(z0 + dz * t - (h[0] + f * (h[columns] - h[0])));
    }
    const double inverseY = 1.0 / double(dy), run = double(dx) * inverseY;
    const std::int64_t stepY = dy > 0 ? 1 : -1;
    for (std::int64_t k = 1; k < std::abs(dy); ++k) {  // grid rows
      const double t = double(k * stepY) * inverseY, x = double(x0) + run * double(k * stepY);
      const double base = double(std::int64_t(x)), f = x - base;
      const double* h = heights_.data() + std::size_t(y0 + k * stepY) * columns + std::size_t(base);
      if (f == 0) continue;
      compare(z0 + dz * t - (h[0] + f * (h[1] - h[0])));
    }
  }
  const std::int64_t across = dx - dy;
  if (across != 0 && std::abs(across) > 1) {  // diagonals column - row = constant, through whole cells
    const double inverse = 1.0 / double(across);
    const std::int64_t step = across > 0 ? 1 : -1;
    for (std::int64_t k = 1; k < std::abs(across); ++k) {
      const double t = double(k * step) * inverse;
      const double x = double(x0) + double(dx) * t, y = double(y0) + double(dy) * t;
      // On the diagonal both fractions are the same; take the one that is exact more often.
      const double base = double(std::int64_t(x)), f = x - base;
      if (f == 0) continue;
      const auto row = static_cast<std::int64_t>(y - f + 0.5);
      if (row < 0 || row + 1 >= std::int64_t(rows_) || std::size_t(base) + 1 >= columns) continue;
      const double* h = heights_.data() + std::size_t(row) * columns + std::size_t(base);
      compare(z0 + dz * t - (h[0] + f * (h[columns + 1] - h[0])));
    }
  }
  const std::int64_t along = dx + dy;
  if (reachesBeyondRims_ && std::abs(along) > 1) {
    const double inverse = 1.0 / double(along);
    const std::int64_t step = along > 0 ? 1 : -1;
    for (std::int64_t k = 1; k < std::abs(along); ++k) {
      const double t = double(k * step) * inverse;
      const double x = double(x0) + double(dx) * t, y = double(y0) + double(dy) * t;
      const double base = double(std::int64_t(x)), f = x - base;
      if (f == 0) continue;
      const auto row = static_cast<std::int64_t>(y - (1 - f) + 0.5);
      if (row < 0 || row + 1 >= std::int64_t(rows_) || std::size_t(base) + 1 >= columns) continue;
      const double* h = heights_.data() + std::size_t(row) * columns + std::size_t(base);
      // From the lower-left to the upper-right sample; an edge of the finest triangulation in half cells
      // only.
      const bool isHalfCell = std::isnan(h[0]) != std::isnan(h[columns + 1]);
      if (isHalfCell) compare(z0 + dz * t - (h[columns] + f * (h[1] - h[columns])));
    }
  }
  return {std::max(0.0, -low), std::max(0.0, high)};
}

}  // namespace arete
