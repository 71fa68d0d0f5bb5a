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

/// Steps floor(numerator / denominator) of a line by rows: x = x0 + (y - y0) dx / dy.
class EdgeStepper {
 public:
  EdgeStepper(std::int64_t x0, std::int64_t dx, std::int64_t dy, bool roundUp) {
    // ceil(a / b) = floor((a + b - 1) / b) for b > 0.
    denominator_ = dy;
    x_ = x0;
    remainder_ = roundUp ? dy - 1 : 0;
    step_ = dx >= 0 ? dx / dy : -((-dx + dy - 1) / dy);
    rest_ = dx - step_ * dy;
  }
  std::int64_t x() const { return x_; }
  void advance() {
    x_ += step_;
    remainder_ += rest_;
    if (remainder_ >= denominator_) {
      remainder_ -= denominator_;
      ++x_;
    }
  }

 private:
  std::int64_t x_, step_, rest_, remainder_, denominator_;
};

}  // namespace

/// Calls row(first sample, count, plane at the first sample, plane step per column); stops when it returns
/// false.
template <class Row>
void RasterError::forRows(std::uint32_t a, std::uint32_t b, std::uint32_t c, const Row& row) const {
  struct Corner {
    std::int64_t x, y;
    double z;
  };
  const auto corner = [&](std::uint32_t v) {
    const LatticePlan::Cell cell = plan_.cell(v);
    return Corner{cell.column, cell.row, heights_[v]};
  };
  Corner p = corner(a), q = corner(b), r = corner(c);
  const std::int64_t area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  if (area == 1) return;  // by Pick's theorem it covers its corners and nothing else
  const double inverse = 1.0 / double(area);
  const double stepX = ((q.z - p.z) * double(r.y - p.y) - (r.z - p.z) * double(q.y - p.y)) * inverse;
  const double stepY = ((r.z - p.z) * double(q.x - p.x) - (q.z - p.z) * double(r.x - p.x)) * inverse;
  // Corner p of the caller anchors the plane, whatever the sorting below does.
  const double z0 = p.z;
  const std::int64_t x0 = p.x, y0 = p.y;

  if (q.y < p.y) std::swap(p, q);
  if (r.y < q.y) std::swap(q, r);
  if (q.y < p.y) std::swap(p, q);

  const std::uint32_t columns = plan_.columns();
  const auto emit = [&](std::int64_t y, std::int64_t left, std::int64_t right) {
    if (left > right) return true;
    const double z = z0 + stepX * double(left - x0) + stepY * double(y - y0);
    return row(std::size_t(y) * columns + std::size_t(left), std::size_t(right - left + 1), z, stepX);
  };
  if (p.y == r.y) return;  // no area

  // The long edge p-r on one side, p-q and q-r on the other.
  const bool middleIsRight = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x) > 0;
  EdgeStepper along(p.x, r.x - p.x, r.y - p.y, !middleIsRight ? false : true);
  std::int64_t y = p.y;
  if (p.y < q.y) {
    EdgeStepper upper(p.x, q.x - p.x, q.y - p.y, !middleIsRight);
    for (; y < q.y; ++y, along.advance(), upper.advance())
      if (!(middleIsRight ? emit(y, along.x(), upper.x()) : emit(y, upper.x(), along.x()))) return;
  }
  if (q.y == r.y) {
    if (middleIsRight)
      emit(y, along.x(), q.x);
    else
      emit(y, q.x, along.x());
    return;
  }
  EdgeStepper lower(q.x, r.x - q.x, r.y - q.y, !middleIsRight);
  for (; y <= r.y; ++y, along.advance(), lower.advance())
    if (!(middleIsRight ? emit(y, along.x(), lower.x()) : emit(y, lower.x(), along.x()))) return;
}

double RasterError::maximum(std::uint32_t a, std::uint32_t b, std::uint32_t c, double limit) const {
  double worst = 0;
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

double RasterError::maximum(std::uint32_t a, std::uint32_t b, std::uint32_t c, SignedBound& bound) const {
  double high = 0, low = 0;
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

SignedBound RasterError::alongEdge(std::uint32_t a, std::uint32_t b) const {
  const LatticePlan::Cell ca = plan_.cell(a), cb = plan_.cell(b);
  const std::int64_t x0 = ca.column, y0 = ca.row, dx = std::int64_t(cb.column) - x0,
                     dy = std::int64_t(cb.row) - y0;
  const double z0 = heights_[a], dz = heights_[b] - heights_[a];
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
      const double base = std::floor(y), f = y - base;
      const double* h = heights_.data() + std::size_t(base) * columns + std::size_t(x0 + k * stepX);
      if (f == 0) continue;  // a sample: the scan has it
      compare(z0 + dz * t - (h[0] + f * (h[columns] - h[0])));
    }
    const double inverseY = 1.0 / double(dy), run = double(dx) * inverseY;
    const std::int64_t stepY = dy > 0 ? 1 : -1;
    for (std::int64_t k = 1; k < std::abs(dy); ++k) {  // grid rows
      const double t = double(k * stepY) * inverseY, x = double(x0) + run * double(k * stepY);
      const double base = std::floor(x), f = x - base;
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
      const double base = std::floor(x), f = x - base;
      if (f == 0) continue;
      const auto row = static_cast<std::int64_t>(std::llround(y - f));
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
      const double base = std::floor(x), f = x - base;
      if (f == 0) continue;
      const auto row = static_cast<std::int64_t>(std::llround(y - (1 - f)));
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
