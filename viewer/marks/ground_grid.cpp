// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/marks/ground_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "viewer/marks/units_of_axes.h"
#include "viewer/picture/ticks.h"

namespace arete {
namespace {

constexpr Rgba kGridInk = {70, 78, 88, 150}, kFifthInk = {40, 46, 54, 255};
/// Squares along the longer side, at least.
constexpr double kSquares = 8;
/// Pieces of a line of a map, which follow a curved Earth.
constexpr int kPieces = 24;
/// Below the lowest place, of the diagonal: what is flat at the bottom hides no grid.
constexpr double kBelow = 2e-3;

double part(const Vec3& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

/// A level plane with two coordinates.
struct GridPlane {
  std::function<Vec3(double, double)> at;
  Vec2 low, high;
  std::string unit;
};

/// The axis of the file that points up or down; nothing where it is turned.
std::optional<std::size_t> levelAxis(const Subject& subject) {
  const Box3 box = subject.fileBox();
  const Vec3 corner = subject.fromFile(box.low);
  const double step = box.longestSide() > 0 ? box.longestSide() : 1;
  std::optional<std::size_t> up;
  for (std::size_t a = 0; a < 3; ++a) {
    Vec3 p = box.low;
    (a == 0 ? p.x : a == 1 ? p.y : p.z) += step;
    const Vec3 way = subject.fromFile(p) - corner;
    const double level = std::hypot(way.x, way.y);
    if (level < 1e-9 * std::abs(way.z))
      up = a;
    else if (std::abs(way.z) > 1e-9 * level)
      return std::nullopt;
  }
  return up;
}

GridPlane planeOf(const Subject& subject) {
  const MetricBox box = subject.box();
  const double z = box.low.z - kBelow * box.diagonal();
  const auto up = levelAxis(subject);
  const auto units = unitsOfAxes(subject);
  if (!up)
    return {[=](double u, double v) {
              return Vec3{u, v, z};
            },
            {box.low.x, box.low.y},
            {box.high.x, box.high.y},
            units[2]};
  const Box3 inFile = subject.fileBox();
  const std::size_t first = *up == 0 ? 1 : 0, second = *up == 2 ? 1 : 2;
  const auto at = [&subject, z, first, second, low = inFile.low](double u, double v) {
    Vec3 p = low;
    for (const auto& [axis, to] : {std::pair{first, u}, {second, v}})
      (axis == 0 ? p.x : axis == 1 ? p.y : p.z) = to;
    Vec3 metric = subject.fromFile(p);
    metric.z = z;
    return metric;
  };
  return {at,
          {part(inFile.low, first), part(inFile.low, second)},
          {part(inFile.high, first), part(inFile.high, second)},
          units[first]};
}

}  // namespace

MarkLines groundGrid(const Subject& subject) {
  MarkLines grid;
  const GridPlane plane = planeOf(subject);
  const double side = std::max(plane.high.x - plane.low.x, plane.high.y - plane.low.y);
  const double step = roundDownNice((side > 0 ? side : 1) / kSquares);
  struct Range {
    double first, last;  // multiples of the step
  };
  const auto around = [&](double low, double high) {
    Range r{std::floor(low / step), std::ceil(high / step)};
    if (r.first == r.last) r = {r.first - 1, r.last + 1};
    return r;
  };
  const Range us = around(plane.low.x, plane.high.x), vs = around(plane.low.y, plane.high.y);
  const int pieces = subject.isTerrain() ? kPieces : 1;
  const auto draw = [&](const Range& each, const Range& other, bool isSwapped) {
    const auto at = [&](double a, double b) {
      return isSwapped ? plane.at(b * step, a * step) : plane.at(a * step, b * step);
    };
    const int count = int(each.last - each.first);
    for (int i = 0; i <= count; ++i) {
      const double n = each.first + i;
      const Rgba& ink = std::fmod(n, 5) == 0 ? kFifthInk : kGridInk;
      for (int p = 0; p < pieces; ++p) {
        const double from = other.first + (other.last - other.first) * p / pieces,
                     to = other.first + (other.last - other.first) * (p + 1) / pieces;
        grid.lines.addLine(at(n, from), at(n, to), ink);
      }
    }
  };
  draw(us, vs, false);
  draw(vs, us, true);
  grid.legend.title = "grid";
  grid.legend.entries.push_back(
      {kFifthInk, fmt::format("squares of {}{}", numberOf(step, step), plane.unit), Legend::Mark::line});
  return grid;
}

}  // namespace arete
