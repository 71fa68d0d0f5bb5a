// SPDX-License-Identifier: GPL-3.0-or-later
//
// All plan positions are integers. A row of a triangle runs from one rounded quotient to another; an edge
// crosses a column, a row or a diagonal at a quotient too. Heights are computed in doubles with a generous
// bound of the rounding error; where that does not suffice, exact arithmetic decides.
#include "terrain/laws/raster_error_law.h"

#include <algorithm>
#include <limits>

namespace arete::laws {
namespace {

constexpr double kRounding = 0x1p-48, kTiny = 0x1p-1030;

std::int64_t floorOf(std::int64_t numerator, std::int64_t denominator) {  // denominator > 0
  const std::int64_t quotient = numerator / denominator;
  return quotient - (numerator % denominator < 0 ? 1 : 0);
}

std::int64_t ceilOf(std::int64_t numerator, std::int64_t denominator) {
  return -floorOf(-numerator, denominator);
}

}  // namespace

RasterErrorLaw::Sample RasterErrorLaw::sampleAt(std::int64_t x, std::int64_t y) const {
  const std::int64_t row = y - top_;
  if (row < 0 || row >= std::int64_t(field_.rows)) return {x, y, std::numeric_limits<double>::quiet_NaN()};
  return {x, y, field_.heights[static_cast<std::size_t>(row) * field_.columns + static_cast<std::size_t>(x)]};
}

bool RasterErrorLaw::holds(std::uint32_t triangle) const {
  const StoredErrors stored = storedErrors(mt_, triangle);
  const auto corners = mt_.corners(TriangleId(triangle));
  std::array<Sample, 3> corner;
  for (std::size_t i = 0; i < 3; ++i) {
    // A corner may be in another row than those of the field.
    const std::uint32_t sample = mt_.vertices().samples[corners[i]];
    corner[i] = {sample % field_.columns, sample / field_.columns,
                 mt_.vertices().height(VertexId(corners[i]))};
  }
  return holdsAtSamples(stored, corner) && holdsAlong(stored, corner[0], corner[1]) &&
         holdsAlong(stored, corner[1], corner[2]) && holdsAlong(stored, corner[2], corner[0]);
}

bool RasterErrorLaw::holdsAtSamples(const StoredErrors& stored, const std::array<Sample, 3>& corner) const {
  const auto& [a, b, c] = corner;
  const auto left = [](const Sample& from, const Sample& to, std::int64_t x, std::int64_t y) {
    return (to.x - from.x) * (y - from.y) - (to.y - from.y) * (x - from.x);
  };
  const double area = double(left(a, b, c.x, c.y)), riseB = b.z - a.z, riseC = c.z - a.z;
  const double rises = std::abs(riseB) + std::abs(riseC);
  const std::int64_t first = std::max(std::min({a.y, b.y, c.y}), top_),
                     last = std::min(std::max({a.y, b.y, c.y}), top_ + std::int64_t(field_.rows) - 1);
  for (std::int64_t y = first; y <= last; ++y) {
    std::int64_t low = std::numeric_limits<std::int64_t>::min(),
                 high = std::numeric_limits<std::int64_t>::max();
    for (std::size_t i = 0; i < 3; ++i) {
      const Sample &from = corner[i], &to = corner[(i + 1) % 3];
      const std::int64_t dx = to.x - from.x, dy = to.y - from.y;
      if (dy > 0) high = std::min(high, from.x + floorOf(dx * (y - from.y), dy));
      if (dy < 0) low = std::max(low, from.x + ceilOf(-dx * (y - from.y), -dy));
    }
    for (std::int64_t x = low; x <= high; ++x) {
      const Sample p = sampleAt(x, y);
      if (std::isnan(p.z)) continue;
      const double difference =
          (a.z - p.z) + (double(left(c, a, x, y)) * riseB + double(left(a, b, x, y)) * riseC) / area;
      const double rounding = rises > 0 ? kRounding * (rises + std::abs(difference)) + kTiny : 0;
      if (stored.hold(difference, rounding)) continue;
      if (!holdAtSample(stored, {a.vec(), b.vec(), c.vec()}, p.vec())) return false;
    }
  }
  return true;
}

bool RasterErrorLaw::holdsAlong(const StoredErrors& stored, const Sample& a, const Sample& b) const {
  const std::int64_t dx = b.x - a.x, dy = b.y - a.y;
  const double rise = b.z - a.z;
  /// The crossing at the part k / lines of the segment, and the part f / lines of the edge from p to q.
  const auto holdsAt = [&](std::int64_t k, std::int64_t lines, const Sample& p, const Sample& q,
                           std::int64_t f) {
    const double between = q.z - p.z;
    if (std::isnan(between)) return true;
    const double difference =
        (a.z - p.z) + rise * (double(k) / double(lines)) - between * (double(f) / double(lines));
    const double terms = std::abs(rise) + std::abs(between);
    const double rounding = terms > 0 ? kRounding * (terms + std::abs(difference)) + kTiny : 0;
    return stored.holdBound(difference, rounding) ||
           holdAtCrossing(stored, a.vec(), b.vec(), p.vec(), q.vec());
  };
  const auto isInside = [&](std::int64_t x, std::int64_t y) {
    return x >= 0 && y >= top_ && x + 1 < std::int64_t(field_.columns) &&
           y + 1 < top_ + std::int64_t(field_.rows);
  };
  const std::int64_t columns = std::abs(dx), rows = std::abs(dy);
  for (std::int64_t k = 1; k < columns; ++k) {
    const std::int64_t x = a.x + (dx > 0 ? k : -k), y = a.y + floorOf(dy * k, columns);
    const std::int64_t f = dy * k - (y - a.y) * columns;
    if (f != 0 && !holdsAt(k, columns, sampleAt(x, y), sampleAt(x, y + 1), f)) return false;
  }
  for (std::int64_t k = 1; k < rows; ++k) {
    const std::int64_t y = a.y + (dy > 0 ? k : -k), x = a.x + floorOf(dx * k, rows);
    const std::int64_t f = dx * k - (x - a.x) * rows;
    if (f != 0 && !holdsAt(k, rows, sampleAt(x, y), sampleAt(x + 1, y), f)) return false;
  }
  // Diagonals along which column - row is constant, from upper left to lower right.
  const std::int64_t across = std::abs(dx - dy);
  for (std::int64_t k = 1; k < across; ++k) {
    const std::int64_t x = a.x + floorOf(dx * k, across), f = dx * k - (x - a.x) * across;
    const std::int64_t y = a.y + floorOf(dy * k, across);
    if (f == 0 || !isInside(x, y)) continue;
    if (!holdsAt(k, across, sampleAt(x, y), sampleAt(x + 1, y + 1), f)) return false;
  }
  // In a cell with three valid corners the other diagonal may be the edge.
  const std::int64_t along = std::abs(dx + dy);
  for (std::int64_t k = 1; k < along; ++k) {
    const std::int64_t x = a.x + floorOf(dx * k, along), f = dx * k - (x - a.x) * along;
    const std::int64_t y = a.y + floorOf(dy * k, along);
    if (f == 0 || !isInside(x, y)) continue;
    if (std::isnan(sampleAt(x, y).z) == std::isnan(sampleAt(x + 1, y + 1).z)) continue;
    if (!holdsAt(k, along, sampleAt(x, y + 1), sampleAt(x + 1, y), f)) return false;
  }
  return true;
}

}  // namespace arete::laws
