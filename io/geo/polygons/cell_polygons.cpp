// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs of equal values in neighbouring rows are joined by union and find. Then the rings are traced, each
// from a top edge that no ring has yet: edges lead around the cells of a polygon with these on the left, and
// turn left where only the cell across the corner has the value, which belongs to another polygon or comes
// back later. A corner that a ring meets twice divides it into two rings: the part between the visits is a
// ring of its own. In this way an outer ring that closes around a hole in a corner becomes an outer ring and
// a hole, which meet there.
#include "io/geo/polygons/cell_polygons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace arete {
namespace {

using Ring = std::vector<CellCorner>;

/// Twice the signed area; positive: counterclockwise, with rows counted downwards.
double doubleAreaOf(const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const CellCorner &a = ring[i], &b = ring[(i + 1) % ring.size()];
    sum += double(b.column) * double(a.row) - double(a.column) * double(b.row);
  }
  return sum;
}

bool areEqual(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

/// Runs of equal values, and which of them are connected.
class Runs {
 public:
  explicit Runs(const CellValues& raster) : raster_(raster) {}

  /// Errors: interrupted.
  Status find(const RunContext& context) {
    rowFirst_.push_back(0);
    for (std::uint32_t row = 0; row < raster_.rows; ++row) {
      if (context.cancelled()) return failure(ErrorCode::interrupted, "the polygons were stopped");
      for (std::uint32_t column = 0; column < raster_.columns; ++column)
        if (column == 0 || !areEqual(raster_.at(column, row), raster_.at(column - 1, row))) {
          begins_.push_back(column);
          parents_.push_back(std::uint32_t(parents_.size()));
          if (parents_.size() == std::numeric_limits<std::uint32_t>::max())
            return failure(ErrorCode::unsupported, "the answer changes at more cells than can be numbered");
        }
      rowFirst_.push_back(begins_.size());
      if (row > 0) joinToRowAbove(row);
    }
    for (std::uint32_t run = 0; run < parents_.size(); ++run) parents_[run] = rootOf(run);
    return {};
  }

  std::size_t firstOf(std::uint32_t row) const { return rowFirst_[row]; }
  CellRun at(std::size_t run, std::uint32_t row) const {
    return {row, begins_[run], run + 1 < rowFirst_[row + 1] ? begins_[run + 1] : raster_.columns};
  }
  /// The first run of those that are connected with it. Call after find().
  std::uint32_t polygonOf(std::size_t run) const { return parents_[run]; }

 private:
  std::uint32_t rootOf(std::uint32_t run) {
    while (parents_[run] != run) run = parents_[run] = parents_[parents_[run]];
    return run;
  }

  void joinToRowAbove(std::uint32_t row) {
    std::size_t above = rowFirst_[row - 1];
    for (std::size_t run = rowFirst_[row]; run < rowFirst_[row + 1]; ++run) {
      const CellRun own = at(run, row);
      while (at(above, row - 1).end <= own.begin) ++above;
      for (std::size_t other = above; other < rowFirst_[row]; ++other) {
        const CellRun upper = at(other, row - 1);
        if (upper.begin >= own.end) break;
        if (raster_.at(upper.begin, row - 1) != raster_.at(own.begin, row)) continue;
        // The root is the first run of all.
        const auto [low, high] = std::minmax({rootOf(std::uint32_t(run)), rootOf(std::uint32_t(other))});
        parents_[high] = low;
      }
    }
  }

  const CellValues& raster_;
  std::vector<std::uint32_t> begins_, parents_;
  std::vector<std::size_t> rowFirst_;
};

/// Traces rings.
class Tracer {
 public:
  explicit Tracer(const CellValues& raster)
      : raster_(raster), traced_(std::size_t(raster.columns) * raster.rows) {}

  /// Whether the top edge of a cell is one of a ring that is not traced yet.
  bool isOpen(std::uint32_t column, std::uint32_t row) const {
    return !traced_[std::size_t(row) * raster_.columns + column] &&
           !hasValue(raster_.at(column, row), column, std::int64_t(row) - 1);
  }

  /// Traces the ring of a top edge, and divides it where it meets itself.
  void trace(std::uint32_t column, std::uint32_t row, std::vector<Ring>& rings) {
    value_ = raster_.at(column, row);
    chain_.clear();
    places_.clear();
    std::int64_t x = column + 1, y = row;
    const std::int64_t firstX = x, firstY = y;
    Way way = west;
    do {
      x += kSteps[way].x;
      y += kSteps[way].y;
      if (way == west) traced_[std::size_t(y) * raster_.columns + std::size_t(x)] = true;
      const bool isLeft = hasAhead(x, y, way, true), isRight = hasAhead(x, y, way, false);
      if (isLeft && !isRight) continue;
      way = Way(isLeft ? (way + 3) % 4 : (way + 1) % 4);
      addCorner({std::uint32_t(x), std::uint32_t(y)}, !isLeft && isRight, rings);
    } while (x != firstX || y != firstY || way != west);
    rings.push_back(chain_);
  }

 private:
  /// Each is a turn to the left of the one before.
  enum Way { west, south, east, north };
  struct Step {
    int x, y;
  };
  static constexpr std::array<Step, 4> kSteps = {Step{-1, 0}, {0, 1}, {1, 0}, {0, -1}};
  /// The cells ahead of a corner, on the left and on the right: the corner's column and row plus these.
  static constexpr std::array<Step, 4> kLeft = {Step{-1, 0}, {0, 0}, {0, -1}, {-1, -1}};
  static constexpr std::array<Step, 4> kRight = {Step{-1, -1}, {-1, 0}, {0, 0}, {0, -1}};

  bool hasValue(double value, std::int64_t column, std::int64_t row) const {
    return column >= 0 && row >= 0 && column < raster_.columns && row < raster_.rows &&
           raster_.at(std::uint32_t(column), std::uint32_t(row)) == value;
  }
  bool hasAhead(std::int64_t x, std::int64_t y, Way way, bool left) const {
    const Step& cell = (left ? kLeft : kRight)[way];
    return hasValue(value_, x + cell.x, y + cell.y);
  }

  /// @param isPinched whether the cells that have the value meet in the corner only: a ring may come twice
  void addCorner(CellCorner corner, bool isPinched, std::vector<Ring>& rings) {
    if (isPinched) {
      const auto [place, isNew] = places_.try_emplace(keyOf(corner), chain_.size());
      if (!isNew) {
        const std::size_t first = place->second;
        rings.emplace_back(chain_.begin() + std::ptrdiff_t(first), chain_.end());
        for (std::size_t i = first + 1; i < chain_.size(); ++i) places_.erase(keyOf(chain_[i]));
        chain_.resize(first + 1);
        return;
      }
    }
    chain_.push_back(corner);
  }
  static std::uint64_t keyOf(CellCorner corner) { return std::uint64_t(corner.row) << 32 | corner.column; }

  const CellValues& raster_;
  std::vector<bool> traced_;
  double value_ = 0;
  Ring chain_;
  std::unordered_map<std::uint64_t, std::size_t> places_;  // of the pinched corners of the chain
};

struct Part {
  std::uint64_t cells = 0, runsSeen = 0;
  double area = 0;
  std::vector<Ring> rings;
};

}  // namespace

Status forCellPolygons(const CellValues& raster, const std::function<double(const CellRun&)>& areaOf,
                       const std::function<Status(CellPolygon)>& take, std::string_view stage,
                       const RunContext& context) {
  context.report(stage, 0);
  Runs runs(raster);
  ARETE_CHECK(runs.find(context));
  std::unordered_map<std::uint32_t, Part> parts;
  std::vector<std::uint32_t> runsOf(runs.firstOf(raster.rows), 0);
  for (std::size_t run = 0; run < runsOf.size(); ++run) ++runsOf[runs.polygonOf(run)];
  Tracer tracer(raster);
  for (std::uint32_t row = 0; row < raster.rows; ++row) {
    if (context.cancelled()) return failure(ErrorCode::interrupted, "the polygons were stopped");
    context.report(stage, double(row) / raster.rows);
    for (std::size_t run = runs.firstOf(row); run < runs.firstOf(row + 1); ++run) {
      const CellRun cells = runs.at(run, row);
      const double value = raster.at(cells.begin, row);
      if (std::isnan(value)) continue;
      const std::uint32_t polygon = runs.polygonOf(run);
      Part& part = parts[polygon];
      part.cells += cells.end - cells.begin;
      part.area += areaOf(cells);
      for (std::uint32_t column = cells.begin; column < cells.end; ++column)
        if (tracer.isOpen(column, row)) tracer.trace(column, row, part.rings);
      if (++part.runsSeen < runsOf[polygon]) continue;
      const auto outer = std::ranges::find_if(part.rings, [](const Ring& r) { return doubleAreaOf(r) > 0; });
      std::iter_swap(part.rings.begin(), outer);
      CellPolygon whole{value, part.cells, part.area, std::move(part.rings)};
      parts.erase(polygon);
      ARETE_CHECK(take(std::move(whole)));
    }
  }
  context.report(stage, 1);
  return {};
}

}  // namespace arete
