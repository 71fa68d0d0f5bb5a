// SPDX-License-Identifier: GPL-3.0-or-later
//
// The difference between a triangle and the finest triangulation is linear on every face of the overlay of
// the two, so its extremes lie at the overlay's vertices. These are the samples inside the triangle, its
// corners (where the difference is zero) and the crossings of its edges with edges of the finest
// triangulation: grid columns, grid rows and the diagonals of the cells. A diagonal runs from the upper-left
// to the lower-right sample, along a line column - row = constant. The crossings of a short edge come from a
// table (edge_crossing_table.h). Where a triangle reaches beyond the domain's rim, half cells on the rim add
// the other diagonals. Crossings at a sample are left out: the scan of the samples includes them.
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "terrain/error/exact_error.h"
#include "terrain/error/raster_error.h"

namespace arete {
namespace {

Vec3 position(const RasterError::Corner& p) {
  return {double(p.x), double(p.y), p.z};
}

/// The differences at crossings. Unless kIsSure, exact arithmetic decides the signs of those that may have
/// lost theirs to rounding, and such a difference counts as one of the size of the rounding error.
template <bool kIsSure>
class Crossings {
 public:
  explicit Crossings(double rounding) : rounding_(rounding) {}

  /// @param isLevel  whether both edges are level, which leaves no rounding error
  /// @param sign     of the exact difference
  template <class Sign>
  void include(double difference, bool isLevel, const Sign& sign) {
    high_ = difference > high_ ? difference : high_;  // false for NODATA
    low_ = difference < low_ ? difference : low_;
    if constexpr (!kIsSure)
      if (std::abs(difference) <= rounding_ && !isLevel) [[unlikely]] {
        const double decided = rounding_ * sign();
        high_ = std::max(high_, decided);
        low_ = std::min(low_, decided);
      }
  }
  SignedBound bound() const { return {0 - low_, high_}; }  // -low_ would give -0

 private:
  double rounding_;
  double high_ = 0, low_ = 0;
};

/// Collects the segment's height minus the finest triangulation's where the segment crosses lattice lines.
template <bool kIsSure, class Height>
class LongEdge {
 public:
  LongEdge(const RasterError::Corner& a, const RasterError::Corner& b, const Height* heights,
           std::size_t columns, std::uint32_t rows, double rounding)
      : x0_(a.x),
        y0_(a.y),
        dx_(b.x - a.x),
        dy_(b.y - a.y),
        z0_(a.z),
        dz_(b.z - a.z),
        endHeight_(b.z),
        heights_(heights),
        columns_(columns),
        rows_(rows),
        crossings_(rounding) {}

  /// Precondition: the segment does not run along a column.
  void crossColumns() {
    crossLines(dx_, y0_, dy_, [&](double t, std::int64_t k, std::int64_t row, double f) {
      const Height* h = sample(row, x0_ + k);
      include(t, h, h + columns_, f);
    });
  }
  /// Precondition: the segment does not run along a row.
  void crossRows() {
    crossLines(dy_, x0_, dx_, [&](double t, std::int64_t k, std::int64_t column, double f) {
      const Height* h = sample(y0_ + k, column);
      include(t, h, h + 1, f);
    });
  }
  /// Diagonals column - row = constant, which cross whole cells.
  void crossDiagonals() {
    // On the diagonal both fractions are equal; the one along the column is exact more often.
    crossDiagonals(
        dx_ - dy_, [](double f) { return f; },
        [&](double t, const Height* h, double f) { include(t, h, h + columns_ + 1, f); });
  }
  /// Diagonals column + row = constant, from the lower-left to the upper-right sample: these are edges of
  /// the finest triangulation in half cells only.
  void crossDiagonalsOfHalfCells() {
    crossDiagonals(
        dx_ + dy_, [](double f) { return 1 - f; },
        [&](double t, const Height* h, double f) {
          const bool isHalfCell = std::isnan(h[0]) != std::isnan(h[columns_ + 1]);
          if (isHalfCell) include(t, h + columns_, h + 1, f);
        });
  }

  SignedBound bound() const { return crossings_.bound(); }

 private:
  /// Visits the crossings with columns (or rows). `lines`: how many columns the segment's end is away;
  /// `from`, `rise`: the row where the segment starts, and how many rows its end is away.
  template <class Visit>
  static void crossLines(std::int64_t lines, std::int64_t from, std::int64_t rise, const Visit& visit) {
    const double inverse = 1.0 / double(lines), slope = double(rise) * inverse;
    const std::int64_t step = lines > 0 ? 1 : -1;
    for (std::int64_t k = step; k != lines; k += step) {
      const double at = double(from) + slope * double(k), base = double(std::int64_t(at));
      if (at != base) visit(double(k) * inverse, k, std::int64_t(base), at - base);
    }
  }
  /// Visits the crossings with diagonals. `across`: how many diagonals the segment's end is away. inRow(f):
  /// how far below its cell's first row a crossing lies that is f to the right of its cell's first column.
  template <class InRow, class Visit>
  void crossDiagonals(std::int64_t across, const InRow& inRow, const Visit& visit) const {
    if (across == 0) return;
    const double inverse = 1.0 / double(across);
    const std::int64_t step = across > 0 ? 1 : -1;
    for (std::int64_t k = step; k != across; k += step) {
      const double t = double(k) * inverse;
      const double x = double(x0_) + double(dx_) * t, y = double(y0_) + double(dy_) * t;
      const double base = double(std::int64_t(x)), f = x - base;
      if (f == 0) continue;
      const auto row = static_cast<std::int64_t>(y - inRow(f) + 0.5);
      if (row < 0 || row + 1 >= std::int64_t(rows_) || std::size_t(base) + 1 >= columns_) continue;
      visit(t, sample(row, std::int64_t(base)), f);
    }
  }

  const Height* sample(std::int64_t row, std::int64_t column) const {
    return heights_ + std::size_t(row) * columns_ + std::size_t(column);
  }
  /// The crossing at the part t of the segment, a fraction f of the way between two samples.
  void include(double t, const Height* p, const Height* q, double f) {
    const double from = *p, to = *q;
    crossings_.include(z0_ + dz_ * t - (from + f * (to - from)), dz_ == 0 && from == to, [&] {
      const Vec3 start{double(x0_), double(y0_), z0_}, end{double(x0_ + dx_), double(y0_ + dy_), endHeight_};
      return signAtCrossing(start, end, at(p), at(q));
    });
  }
  Vec3 at(const Height* sample) const {
    const auto index = static_cast<std::size_t>(sample - heights_);
    return {double(index % columns_), double(index / columns_), double(*sample)};
  }

  std::int64_t x0_, y0_, dx_, dy_;
  double z0_, dz_, endHeight_;
  const Height* heights_;
  std::size_t columns_;
  std::uint32_t rows_;
  Crossings<kIsSure> crossings_;
};

}  // namespace

SignedBound RasterError::alongShortEdge(const Corner& a, const Corner& b) const {
  const double dz = b.z - a.z;
  const std::size_t start = std::size_t(a.y) * plan_.columns() + std::size_t(a.x);
  if (!areCrossingsSure_) [[unlikely]]
    return alongUnsureEdge(a, b);
  double high = 0, low = 0;
  heights_.with([&](const auto* heights) {
    heights += start;
    for (const EdgeCrossingTable::Crossing& crossing : edgeCrossings_.of(b.x - a.x, b.y - a.y)) {
      const double from = heights[crossing.from], to = heights[crossing.to];
      const double difference = a.z + dz * crossing.along - (from + crossing.between * (to - from));
      high = difference > high ? difference : high;  // false for NODATA
      low = difference < low ? difference : low;
    }
  });
  return {0 - low, high};  // -low would give -0
}

SignedBound RasterError::alongUnsureEdge(const Corner& a, const Corner& b) const {
  const double dz = b.z - a.z;
  const auto start = std::int64_t(a.y) * plan_.columns() + a.x;
  const auto at = [&](std::int32_t offset) {
    return position(corner(VertexId(static_cast<std::uint32_t>(start + offset))));
  };
  Crossings<false> crossings(crossingRounding_);
  for (const EdgeCrossingTable::Crossing& crossing : edgeCrossings_.of(b.x - a.x, b.y - a.y)) {
    const Vec3 p = at(crossing.from), q = at(crossing.to);
    crossings.include(a.z + dz * crossing.along - (p.z + crossing.between * (q.z - p.z)),
                      dz == 0 && p.z == q.z, [&] { return signAtCrossing(position(a), position(b), p, q); });
  }
  return crossings.bound();
}

SignedBound RasterError::alongLongEdge(const Corner& a, const Corner& b) const {
  const std::int32_t dx = b.x - a.x, dy = b.y - a.y;
  // An edge along a column, a row or a diagonal crosses edges of the finest triangulation at samples only.
  if (dx == 0 || dy == 0 || (dx == dy && !reachesBeyondRims_)) return {};
  const auto boundOf = [&](auto&& edge) {
    edge.crossColumns();
    edge.crossRows();
    edge.crossDiagonals();
    if (reachesBeyondRims_) edge.crossDiagonalsOfHalfCells();
    return edge.bound();
  };
  return heights_.with([&]<class Height>(const Height* heights) {
    const std::size_t columns = plan_.columns();
    if (areCrossingsSure_) return boundOf(LongEdge<true, Height>(a, b, heights, columns, rows_, 0));
    return boundOf(LongEdge<false, Height>(a, b, heights, columns, rows_, crossingRounding_));
  });
}

}  // namespace arete
