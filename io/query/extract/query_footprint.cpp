// SPDX-License-Identifier: GPL-3.0-or-later
//
// A place marks its cell and the cells around it, which exceeds any rounding. A line is divided into steps
// about as long as a cell; each marks the cells of its bounding box. A disc along the ground may have any
// shape in the plan, and several parts where the terrain closes around the Earth. So the grid is a quadtree:
// a square of cells is inside, outside or divided, by the distance of its middle from the centre and of its
// corners from its middle. Squares that are marked already are skipped, because discs of many observers
// overlap.
//
// Whether a box meets a marked cell follows from a summed-area table of the marks [Crow1984].
#include "io/query/extract/query_footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "terrain/model/plan_box.h"

namespace arete {
namespace {

/// The most steps of a line. If it reaches far beyond the terrain its steps are longer than a cell.
constexpr double kMostSteps = 1 << 14;

/// Of a disc: squares of more cells than kSurveyable are divided without a test, those of at most kFinest are
/// not divided. kBent: how much longer the way from the middle to the rim of a square may be than to its
/// corners. kBeside: samples around the disc that are marked too.
constexpr int kSurveyable = 64, kFinest = 2;
constexpr double kBent = 1.25, kBeside = 4;

}  // namespace

QueryFootprint::QueryFootprint(const TerrainModel& outline)
    : domain_(planBox(outline)),
      reach_(outline.isRaster ? 1 : 0),
      isMarked_(std::size_t{kCells} * kCells, 0) {
  const double width = domain_.xMax - domain_.xMin, height = domain_.yMax - domain_.yMin;
  columnsPerUnit_ = width > 0 ? kCells / width : 0;
  rowsPerUnit_ = height > 0 ? kCells / height : 0;
}

int QueryFootprint::cellOf(double cells) {
  // NaN, of a domain that overflows doubles or has no extent, is the first cell.
  return cells > 0 ? static_cast<int>(std::min(cells, kCells - 1.0)) : 0;
}

int QueryFootprint::columnOf(double x) const {
  return cellOf((x - domain_.xMin) * columnsPerUnit_);
}

int QueryFootprint::rowOf(double y) const {
  return cellOf((y - domain_.yMin) * rowsPerUnit_);
}

// The cells around a place belong to it too, so that rounding of its coordinates never leaves a cell out.
QueryFootprint::Cells QueryFootprint::cellsAround(Vec2 low, Vec2 high) const {
  return {std::max(columnOf(low.x - reach_) - 1, 0), std::min(columnOf(high.x + reach_) + 1, kCells - 1),
          std::max(rowOf(low.y - reach_) - 1, 0), std::min(rowOf(high.y + reach_) + 1, kCells - 1)};
}

bool QueryFootprint::areMarked(const Cells& cells) const {
  for (int row = cells.bottom; row <= cells.top; ++row) {
    const auto begin = isMarked_.begin() + row * kCells, end = begin + cells.right + 1;
    if (std::find(begin + cells.left, end, std::uint8_t{0}) != end) return false;
  }
  return true;
}

// Cells are marked and never unmarked, so queries can be added in any order.
void QueryFootprint::mark(const Cells& cells) {
  for (int row = cells.bottom; row <= cells.top; ++row) {
    const auto begin = isMarked_.begin() + row * kCells;
    std::fill(begin + cells.left, begin + cells.right + 1, std::uint8_t{1});
  }
}

void QueryFootprint::add(Vec2 plan) {
  if (std::isfinite(plan.x + plan.y)) mark(cellsAround(plan, plan));
}

// A number of steps is bounded, for lines that lead far beyond the domain; longer steps mark larger boxes,
// which is safe.
void QueryFootprint::addLine(Vec2 from, Vec2 to) {
  const Vec2 way{to.x - from.x, to.y - from.y};
  if (!std::isfinite(from.x + from.y) || !std::isfinite(way.x + way.y)) return;
  const double cells = std::max(std::fabs(way.x) * columnsPerUnit_, std::fabs(way.y) * rowsPerUnit_);
  const int steps = cells > 1 ? static_cast<int>(std::ceil(std::min(cells, kMostSteps))) : 1;
  Vec2 begin = from;
  for (int i = 1; i <= steps; ++i) {
    const double part = static_cast<double>(i) / steps;
    const Vec2 end = i == steps ? to : Vec2{from.x + part * way.x, from.y + part * way.y};
    mark(cellsAround({std::min(begin.x, end.x), std::min(begin.y, end.y)},
                     {std::max(begin.x, end.x), std::max(begin.y, end.y)}));
    begin = end;
  }
}

void QueryFootprint::addTrack(const SightTrack& track) {
  for (std::size_t i = 1; i < track.points.size(); ++i)
    addLine(track.points[i - 1].plan, track.points[i].plan);
}

void QueryFootprint::addDisc(const SightEarth& earth, Vec2 centre, double metres) {
  if (std::isfinite(centre.x + centre.y)) addPart({earth, centre, metres}, 0, 0, kCells);
}

void QueryFootprint::addRectangle(double margin) {
  int left = kCells, right = -1, bottom = kCells, top = -1;
  for (int row = 0; row < kCells; ++row)
    for (int column = 0; column < kCells; ++column) {
      if (!isMarked_[static_cast<std::size_t>(row) * kCells + static_cast<std::size_t>(column)]) continue;
      left = std::min(left, column), right = std::max(right, column);
      bottom = std::min(bottom, row), top = std::max(top, row);
    }
  if (right < left) return;
  const double cellWidth = (domain_.xMax - domain_.xMin) / kCells,
               cellHeight = (domain_.yMax - domain_.yMin) / kCells;
  const double more = margin * std::max((right - left + 1) * cellWidth, (top - bottom + 1) * cellHeight);
  mark(cellsAround(
      {domain_.xMin + left * cellWidth - more, domain_.yMin + bottom * cellHeight - more},
      {domain_.xMin + (right + 1) * cellWidth + more, domain_.yMin + (top + 1) * cellHeight + more}));
}

// The distance from the middle to a corner, widened for how maps bend, bounds how far any place of the square
// is from its middle. A square whose distances cannot be computed is divided until it can be, or is marked.
void QueryFootprint::addPart(const Disc& disc, int column, int row, int size) {
  const auto at = [&](double columns, double rows) {
    return Vec2{domain_.xMin + (domain_.xMax - domain_.xMin) * (column + columns) / kCells,
                domain_.yMin + (domain_.yMax - domain_.yMin) * (row + rows) / kCells};
  };
  const Vec2 low = at(0, 0), high = at(size, size), middle = at(size / 2.0, size / 2.0);
  const Cells cells = cellsAround({low.x - kBeside * reach_, low.y - kBeside * reach_},
                                  {high.x + kBeside * reach_, high.y + kBeside * reach_});
  if (areMarked(cells)) return;
  constexpr double kInDoubt = std::numeric_limits<double>::infinity();
  double reach = size > kSurveyable ? kInDoubt : 0;
  for (const Vec2 corner : {low, at(size, 0), at(0, size), high}) {
    if (std::isinf(reach)) break;
    reach = std::max(reach, disc.earth.distance(middle, corner).value_or(kInDoubt));
  }
  reach *= kBent;
  const double distance = std::isinf(reach) ? 0 : disc.earth.distance(disc.centre, middle).value_or(0);
  if (distance - reach > disc.metres) return;
  if (size <= kFinest || distance + reach <= disc.metres) return mark(cells);
  const int half = size / 2;
  for (const int down : {0, half})
    for (const int right : {0, half}) addPart(disc, column + right, row + down, half);
}

RequiredError QueryFootprint::within(double error) const {
  // sums[row][column]: the marks of all cells in rows and columns below these.
  constexpr int kStride = kCells + 1;
  const auto sums = std::make_shared<std::vector<std::uint32_t>>(std::size_t{kStride} * kStride, 0);
  for (int row = 0; row < kCells; ++row)
    for (int column = 0; column < kCells; ++column) {
      const auto at = static_cast<std::size_t>(row + 1) * kStride + static_cast<std::size_t>(column) + 1;
      (*sums)[at] = (*sums)[at - 1] + (*sums)[at - kStride] - (*sums)[at - kStride - 1] +
                    isMarked_[static_cast<std::size_t>(row) * kCells + static_cast<std::size_t>(column)];
    }
  return requiredInPlan(
      [places = std::make_shared<const QueryFootprint>(*this), sums, error](const Box2& box) {
        constexpr double kNothing = std::numeric_limits<double>::infinity();
        if (!(box.xMin <= box.xMax && box.yMin <= box.yMax)) return kNothing;
        const auto sum = [&](int row, int column) {
          return (*sums)[static_cast<std::size_t>(row) * kStride + static_cast<std::size_t>(column)];
        };
        const int left = places->columnOf(box.xMin), right = places->columnOf(box.xMax) + 1;
        const int bottom = places->rowOf(box.yMin), top = places->rowOf(box.yMax) + 1;
        const bool isMarked = sum(top, right) + sum(bottom, left) != sum(bottom, right) + sum(top, left);
        return isMarked ? error : kNothing;
      });
}

}  // namespace arete
